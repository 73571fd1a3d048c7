// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "vantage/io/camera_files.h"

#include "core/json_reader.h"

namespace vantage {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

class CameraReader : private JsonReader {
 public:
  using JsonReader::JsonReader;

  Camera read() const {
    if (has(root(), "cameras") && has(root(), "nodes")) {
      return checked(from_gltf());
    }
    if (has(root(), "frames")) {
      return checked(from_transforms());
    }
    if (has(root(), "best")) {
      return checked(from_view());
    }
    fail("holds no camera: expected a glTF with a camera, a transforms.json or a view.json");
  }

 private:
  const Json& member(const Json& object, const char* name) const {
    if (!has(object, name)) {
      fail(std::string("lacks the member ") + name);
    }
    return object.at(name);
  }

  /// An entry of an array, by an index that the file may give.
  const Json& entry(const Json& array, std::size_t index, const char* what) const {
    if (!array.is_array() || index >= array.size()) {
      fail(std::string("lacks ") + what + " " + std::to_string(index));
    }
    return array[index];
  }

  double number(const Json& value, const char* what) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      fail(std::string(what) + " is not a number");
    }
    return value.get<double>();
  }

  Vec3 vector(const Json& value, const char* what) const {
    require_list_of_3(value, what);
    return {number(value[0], what), number(value[1], what), number(value[2], what)};
  }

  Camera from_gltf() const {
    const Json& nodes = member(root(), "nodes");
    for (const Json& node : nodes) {
      if (!has(node, "camera")) {
        continue;
      }
      const Json& index = node.at("camera");
      if (!index.is_number_unsigned()) {
        fail("the camera of a node is not an index");
      }
      const Json& lens = entry(root().at("cameras"), index.get<std::size_t>(), "camera");
      const Json& matrix = member(node, "matrix");
      Eigen::Matrix4d world;
      for (Eigen::Index i = 0; i < 16; ++i) {  // column by column
        world(i % 4, i / 4) =
            number(entry(matrix, static_cast<std::size_t>(i), "matrix entry"), "a matrix entry");
      }
      Camera camera = camera_at(world, has(node, "extras") ? node.at("extras") : Json());
      read_gltf_lens(lens, camera);
      return camera;
    }
    fail("holds no node with a camera");
  }

  void read_gltf_lens(const Json& lens, Camera& camera) const {
    if (has(lens, "perspective")) {
      camera.fov_y_deg =
          number(member(lens.at("perspective"), "yfov"), "perspective.yfov") * kDegPerRad;
    } else {
      camera.projection = Projection::Orthographic;
      camera.height =
          2.0 * number(member(member(lens, "orthographic"), "ymag"), "orthographic.ymag");
    }
  }

  Camera from_transforms() const {
    const Json& frame = entry(root().at("frames"), 0, "frame");
    const Json& rows = member(frame, "transform_matrix");
    Eigen::Matrix4d world;
    for (Eigen::Index r = 0; r < 4; ++r) {
      const Json& row = entry(rows, static_cast<std::size_t>(r), "matrix row");
      for (Eigen::Index c = 0; c < 4; ++c) {
        world(r, c) =
            number(entry(row, static_cast<std::size_t>(c), "matrix entry"), "a matrix entry");
      }
    }
    Camera camera = camera_at(world, frame);
    if (has(root(), "orthographic_height")) {
      camera.projection = Projection::Orthographic;
      camera.height = number(root().at("orthographic_height"), "orthographic_height");
    } else if (has(root(), "camera_angle_y")) {
      camera.fov_y_deg = number(root().at("camera_angle_y"), "camera_angle_y") * kDegPerRad;
    } else {
      const double width = number(member(root(), "w"), "w");
      const double height = number(member(root(), "h"), "h");
      const double half =
          std::tan(0.5 * number(member(root(), "camera_angle_x"), "camera_angle_x"));
      camera.fov_y_deg = 2.0 * std::atan(half * height / width) * kDegPerRad;
    }
    return camera;
  }

  /// \param extras may hold the point looked at; without it, that is one unit ahead.
  Camera camera_at(const Eigen::Matrix4d& world, const Json& extras) const {
    Camera camera;
    camera.eye = world.block<3, 1>(0, 3);
    camera.up = world.block<3, 1>(0, 1);
    const Vec3 back = world.block<3, 1>(0, 2);
    camera.target =
        has(extras, "target") ? vector(extras.at("target"), "target") : Vec3(camera.eye - back);
    return camera;
  }

  /// The picture's camera of the best view.
  Camera from_view() const {
    const Json& best = root().at("best");
    const Json& scoring = member(root(), "camera");
    Camera camera;
    camera.eye = vector(member(best, "eye"), "best.eye");
    camera.up = vector(member(best, "up"), "best.up");
    const Json& frame = has(best, "frame") ? best.at("frame") : scoring;
    camera.target = vector(member(frame, "target"), "target");
    if (has(scoring, "projection") && scoring.at("projection") == "orthographic") {
      camera.projection = Projection::Orthographic;
      camera.height = number(member(frame, "height"), "height");
    } else {
      camera.fov_y_deg = number(member(frame, "fov_y_deg"), "fov_y_deg");
    }
    return camera;
  }

  /// Makes `up` orthogonal to the view direction and checks that there is a picture to take.
  Camera checked(Camera camera) const {
    const Vec3 back = camera.eye - camera.target;
    const Vec3 right = camera.up.cross(back);
    if (!(back.norm() > 0.0) || !(right.norm() > 0.0) || !back.allFinite() ||
        !std::isfinite(right.norm())) {
      fail("its camera looks at its own eye, or along its up direction");
    }
    const Vec3 axis = back.normalized();
    camera.up = axis.cross(right.normalized());
    const bool fits = camera.projection == Projection::Perspective
                          ? camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0
                          : camera.height > 0.0;
    if (!fits) {
      fail("its camera sees nothing: the field of view or the height is out of range");
    }
    return camera;
  }
};

}  // namespace

Camera parse_camera(std::string_view bytes, std::string_view name) {
  return CameraReader(bytes, name).read();
}

}  // namespace vantage
