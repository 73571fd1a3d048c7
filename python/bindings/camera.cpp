// SPDX-License-Identifier: MIT
#include "camera.h"

#include <cmath>

#include "vantage/core/error.h"

#include "arguments.h"
#include "arrays.h"

namespace vantage::python {

py::dict camera_dict(const Camera& camera) {
  py::dict result;
  result["projection"] =
      camera.projection == Projection::Perspective ? "perspective" : "orthographic";
  result["eye"] = array_of(camera.eye);
  result["target"] = array_of(camera.target);
  result["up"] = array_of(camera.up);
  result["fov_y_deg"] = camera.fov_y_deg;
  result["height"] = camera.height;
  return result;
}

Camera camera_of(const py::object& object) {
  for (const char* const name : {"projection", "eye", "target", "up", "fov_y_deg", "height"}) {
    if (!py::hasattr(object, name)) {
      throw py::type_error(std::string("camera must be a vantage.Camera, but has no ") + name);
    }
  }
  Camera camera;
  const auto projection = py::str(object.attr("projection")).cast<std::string>();
  if (projection != "perspective" && projection != "orthographic") {
    throw InvalidInput("camera.projection must be perspective or orthographic, not '" + projection +
                       "'");
  }
  camera.projection =
      projection == "perspective" ? Projection::Perspective : Projection::Orthographic;
  camera.eye = vector_of(object.attr("eye"), "camera.eye");
  camera.target = vector_of(object.attr("target"), "camera.target");
  camera.fov_y_deg = number_of(object.attr("fov_y_deg"), "camera.fov_y_deg");
  camera.height = number_of(object.attr("height"), "camera.height");
  const Vec3 line = camera.target - camera.eye;
  const double distance = line.stableNorm();
  const Vec3 up = vector_of(object.attr("up"), "camera.up");
  const double up_length = up.stableNorm();
  if (!(distance > 0.0) || !(up_length > 0.0)) {
    throw InvalidInput("camera.target must differ from camera.eye, and camera.up from zero");
  }
  if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0)) {
    throw InvalidInput("camera.fov_y_deg must be between 0 and 180");
  }
  if (!(camera.height > 0.0) || !std::isfinite(camera.height)) {
    throw InvalidInput("camera.height must be above 0");
  }
  // Left alone if it is unit and orthogonal already, so that a camera that was given out comes
  // back to the bit.
  const Vec3 forward = line / distance;
  const double tilt = up.dot(forward) / up_length;
  camera.up = up;
  constexpr double kRounding = 1e-12;
  if (std::abs(tilt) > kRounding || std::abs(up_length - 1.0) > kRounding) {
    const Vec3 upright = up / up_length - tilt * forward;
    const double length = upright.norm();
    if (!(length > kRounding)) {
      throw InvalidInput("camera.up must not point along the line of sight");
    }
    camera.up = upright / length;
  }
  return camera;
}

}  // namespace vantage::python
