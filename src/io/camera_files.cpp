// SPDX-License-Identifier: MIT
#include "vantage/io/camera_files.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "core/degrees.h"
#include "core/json_text.h"
#include "io/camera_axes.h"

namespace vantage {
namespace {

/// Camera-to-world: columns are the camera's x (right), y (up), −(view direction), and the eye.
Eigen::Matrix4d camera_to_world(const Camera& camera) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.block<3, 3>(0, 0) = camera_axes(camera);
  matrix.block<3, 1>(0, 3) = camera.eye;
  return matrix;
}

OrderedJson list(const Vec3& v) {
  return OrderedJson::array({v.x(), v.y(), v.z()});
}

double aspect(PictureSize size) {
  if (size.width <= 0 || size.height <= 0) {
    throw InvalidInput("a picture must have at least one pixel");
  }
  return static_cast<double>(size.width) / size.height;
}

std::string triple(const Vec3& v) {
  return number_text(v.x()) + "," + number_text(v.y()) + "," + number_text(v.z());
}

/// `text` in single quotes for a POSIX shell; as $'…', of ASCII, where it would drive a terminal.
std::string shell_quoted(const std::string& text) {
  const bool is_safe = printable(text) == text;
  std::string result = is_safe ? "'" : "$'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_safe) {
      result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    } else if (byte < ' ' || byte > '~') {
      const auto digit = [byte](unsigned shift) {
        return static_cast<char>('0' + ((byte >> shift) & 7U));
      };
      result += {'\\', digit(6), digit(3), digit(0)};
    } else {
      result += c == '\'' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
    }
  }
  return result + "'";
}

/// An orthographic camera as one so far away that what lies half a picture's height nearer than the
/// target is shown 0.05 % larger. f3d 1.3 has no other, and later ones cannot be told the height.
Camera with_view_angle(const Camera& camera) {
  constexpr double kFar = 1000.0;  // picture heights [ours]
  Camera result = camera;
  if (camera.projection == Projection::Orthographic) {
    const Vec3 back = (camera.eye - camera.target).normalized();
    result.projection = Projection::Perspective;
    result.eye = camera.target + kFar * camera.height * back;
    result.fov_y_deg = 2.0 * std::atan(0.5 / kFar) / kRadPerDeg;
  }
  return result;
}

}  // namespace

Camera camera_of_file(const Camera& camera, const Eigen::Matrix3d& turn) {
  Camera result = camera;
  if (!turn.isIdentity(0.0)) {
    result.eye = turn.transpose() * camera.eye;
    result.target = turn.transpose() * camera.target;
    result.up = turn.transpose() * camera.up;
  }
  return result;
}

std::string camera_gltf(const Camera& camera, PictureSize size, double near_far_scale) {
  const Eigen::Matrix4d matrix = camera_to_world(camera);
  const double distance = (camera.target - camera.eye).norm();
  constexpr double kNearestFraction = 1e-3;  // of the scene; znear must be positive
  const double near =
      std::max(distance - near_far_scale, kNearestFraction * std::max(near_far_scale, distance));
  const double far = distance + near_far_scale;
  OrderedJson lens;
  if (camera.projection == Projection::Perspective) {
    lens = {{"type", "perspective"},
            {"perspective",
             {{"yfov", camera.fov_y_deg * kRadPerDeg},
              {"aspectRatio", aspect(size)},
              {"znear", near},
              {"zfar", far}}}};
  } else {
    // xmag and ymag are half the width and half the height of what is seen.
    lens = {{"type", "orthographic"},
            {"orthographic",
             {{"xmag", 0.5 * camera.height * aspect(size)},
              {"ymag", 0.5 * camera.height},
              {"znear", near},
              {"zfar", far}}}};
  }
  const OrderedJson node = {{"name", "camera"},
                            {"camera", 0},
                            {"matrix", std::vector<double>(matrix.data(), matrix.data() + 16)},
                            {"extras", {{"target", list(camera.target)}}}};
  const OrderedJson file = {{"asset", {{"version", "2.0"}, {"generator", "vantage"}}},
                            {"scene", 0},
                            {"scenes", OrderedJson::array({{{"nodes", OrderedJson::array({0})}}})},
                            {"nodes", OrderedJson::array({node})},
                            {"cameras", OrderedJson::array({lens})}};
  return json_text(file, 2) + "\n";
}

std::string camera_transforms_json(const Camera& camera, PictureSize size,
                                   std::string_view image_name) {
  const Eigen::Matrix4d matrix = camera_to_world(camera);
  OrderedJson rows = OrderedJson::array();
  for (int r = 0; r < 4; ++r) {
    rows.push_back({matrix(r, 0), matrix(r, 1), matrix(r, 2), matrix(r, 3)});
  }
  OrderedJson file;
  if (camera.projection == Projection::Perspective) {
    const double half_height = std::tan(0.5 * camera.fov_y_deg * kRadPerDeg);
    const double focal = 0.5 * size.height / half_height;  // px, the same both ways
    file["camera_angle_x"] = 2.0 * std::atan(half_height * aspect(size));
    file["camera_angle_y"] = camera.fov_y_deg * kRadPerDeg;
    file["fl_x"] = focal;
    file["fl_y"] = focal;
  } else {
    file["orthographic_height"] = camera.height;  // ours: the format knows no such camera
  }
  file["cx"] = 0.5 * size.width;
  file["cy"] = 0.5 * size.height;
  file["w"] = size.width;
  file["h"] = size.height;
  file["frames"] = OrderedJson::array({{{"file_path", std::string(image_name)},
                                        {"transform_matrix", rows},
                                        {"target", list(camera.target)}}});
  return json_text(file, 2) + "\n";
}

std::string camera_f3d(const Camera& camera, PictureSize size, std::string_view model,
                       bool of_points) {
  const std::string file = (model.starts_with('-') ? "./" : "") + std::string(model);  // no option
  const Camera lens = with_view_angle(camera);
  return "f3d " + shell_quoted(file) + " --camera-position=" + triple(lens.eye) +
         " --camera-focal-point=" + triple(lens.target) + " --camera-view-up=" + triple(lens.up) +
         " --camera-view-angle=" + number_text(lens.fov_y_deg) +
         " --resolution=" + std::to_string(size.width) + "," + std::to_string(size.height) +
         (of_points ? " --point-sprites" : "") + "\n";
}

}  // namespace vantage
