// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/io/camera_files.h"

#include "core/degrees.h"
#include "core/json_reader.h"

namespace vantage {
namespace {

constexpr std::size_t kMostLevels = 100;  // [ours] of nodes above that of a camera

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

  /// Width over height of the camera's picture.
  std::optional<double> aspect() const {
    if (has(root(), "cameras") && has(root(), "nodes")) {
      return gltf_aspect();
    }
    if (has(root(), "frames")) {
      const Json& frame = entry(root().at("frames"), 0, "frame");
      return ratio(has(frame, "w") ? frame : root(), "w", "h");
    }
    if (has(root(), "best") && has(root().at("best"), "size")) {
      const Json& size = root().at("best").at("size");
      return quotient(number(entry(size, 0, "best.size"), "best.size"),
                      number(entry(size, 1, "best.size"), "best.size"));
    }
    return {};
  }

 private:
  /// Nothing unless both are above 0.
  static std::optional<double> quotient(double width, double height) {
    return width > 0.0 && height > 0.0 ? std::optional(width / height) : std::nullopt;
  }

  std::optional<double> ratio(const Json& object, const char* width, const char* height) const {
    if (!has(object, width) || !has(object, height)) {
      return {};
    }
    return quotient(number(object.at(width), width), number(object.at(height), height));
  }

  std::optional<double> gltf_aspect() const {
    const Json& lens = gltf_lens(gltf_nodes()[gltf_node()]);
    if (has(lens, "orthographic")) {
      return ratio(lens.at("orthographic"), "xmag", "ymag");
    }
    if (!has(lens, "perspective") || !has(lens.at("perspective"), "aspectRatio")) {
      return {};
    }
    return quotient(number(lens.at("perspective").at("aspectRatio"), "aspectRatio"), 1.0);
  }

  const Json& gltf_nodes() const {
    const Json& nodes = member(root(), "nodes");
    if (!nodes.is_array()) {
      fail("its nodes are no list");
    }
    return nodes;
  }

  /// The first node with a camera in the scene that is shown, or else the first of all.
  std::size_t gltf_node() const {
    const Json& nodes = gltf_nodes();
    const std::vector<bool> shown = gltf_shown();
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (has(nodes[i], "camera")) {
        if (shown[i]) {
          return i;
        }
        first = first.value_or(i);
      }
    }
    if (!first) {
      fail("holds no node with a camera");
    }
    return *first;
  }

  /// Of each node, whether the default scene, or else the first, shows it.
  std::vector<bool> gltf_shown() const {
    const Json& nodes = gltf_nodes();
    std::vector<bool> shown(nodes.size(), false);
    std::vector<std::size_t> to_visit;
    const auto show = [&](const Json& object, const char* list) {
      if (!has(object, list) || !object.at(list).is_array()) {
        return;
      }
      for (const Json& node : object.at(list)) {
        const std::size_t n = node.is_number_unsigned() ? node.get<std::size_t>() : nodes.size();
        if (n < nodes.size() && !shown[n]) {
          shown[n] = true;
          to_visit.push_back(n);
        }
      }
    };
    const bool has_default = has(root(), "scene") && root().at("scene").is_number_unsigned();
    const std::size_t scene = has_default ? root().at("scene").get<std::size_t>() : 0;
    if (has(root(), "scenes") && root().at("scenes").is_array() &&
        scene < root().at("scenes").size()) {
      show(root().at("scenes")[scene], "nodes");
    }
    while (!to_visit.empty()) {
      const std::size_t n = to_visit.back();
      to_visit.pop_back();
      show(nodes[n], "children");
    }
    return shown;
  }

  /// The node that another one is a child of.
  std::optional<std::size_t> gltf_parent(std::size_t child) const {
    const Json& nodes = gltf_nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!has(nodes[i], "children") || !nodes[i].at("children").is_array()) {
        continue;
      }
      for (const Json& index : nodes[i].at("children")) {
        if (index.is_number_unsigned() && index.get<std::size_t>() == child) {
          return i;
        }
      }
    }
    return {};
  }

  const Json& gltf_lens(const Json& node) const {
    const Json& index = node.at("camera");
    if (!index.is_number_unsigned()) {
      fail("the camera of a node is not an index");
    }
    return entry(root().at("cameras"), index.get<std::size_t>(), "camera");
  }

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
    const Json& nodes = gltf_nodes();
    const std::size_t index = gltf_node();
    const Json& node = nodes[index];
    Eigen::Matrix4d world = gltf_pose(node);
    std::size_t levels = 0;
    for (auto above = gltf_parent(index); above; above = gltf_parent(*above)) {
      world = gltf_pose(nodes[*above]) * world;
      if (++levels > kMostLevels) {
        fail("the node of its camera stands below itself, or too deep");
      }
    }
    // The point looked at is of the scene, as we write it; whoever put the node below another one may
    // have moved it.
    const bool has_target = levels == 0 && has(node, "extras");
    Camera camera = camera_at(world, has_target ? node.at("extras") : Json());
    read_gltf_lens(gltf_lens(node), camera);
    return camera;
  }

  /// A node's matrix, or what its translation, rotation and scale make; of an animated one, as a tour's, they
  /// are those of its begin.
  Eigen::Matrix4d gltf_pose(const Json& node) const {
    Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
    if (has(node, "matrix")) {
      for (Eigen::Index i = 0; i < 16; ++i) {  // column by column
        world(i % 4, i / 4) =
            number(entry(node.at("matrix"), static_cast<std::size_t>(i), "matrix entry"),
                   "a matrix entry");
      }
      return world;
    }
    if (has(node, "translation")) {
      world.block<3, 1>(0, 3) = vector(node.at("translation"), "translation");
    }
    if (has(node, "rotation")) {
      Eigen::Vector4d turn;  // x, y, z, w
      for (Eigen::Index i = 0; i < 4; ++i) {
        turn[i] =
            number(entry(node.at("rotation"), static_cast<std::size_t>(i), "rotation"), "rotation");
      }
      world.block<3, 3>(0, 0) = Eigen::Quaterniond(turn.normalized()).toRotationMatrix();
    }
    if (has(node, "scale")) {
      world.block<3, 3>(0, 0) *= vector(node.at("scale"), "scale").asDiagonal();
    }
    return world;
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
    // Frames that differ have each their own lens.
    const auto has_lens = [&](const char* name) { return has(frame, name) || has(root(), name); };
    const auto lens = [&](const char* name) {
      return number(has(frame, name) ? frame.at(name) : member(root(), name), name);
    };
    if (has_lens("orthographic_height")) {
      camera.projection = Projection::Orthographic;
      camera.height = lens("orthographic_height");
    } else if (has_lens("camera_angle_y")) {
      camera.fov_y_deg = lens("camera_angle_y") * kDegPerRad;
    } else if (has_lens("camera_angle_x")) {
      // Without a size, as in the synthetic scenes of NeRF, pictures are square.
      const bool has_size = has_lens("w") && has_lens("h");
      const double width = has_size ? lens("w") : 1.0;
      const double height = has_size ? lens("h") : 1.0;
      const double half = std::tan(0.5 * lens("camera_angle_x"));
      camera.fov_y_deg = 2.0 * std::atan(half * height / width) * kDegPerRad;
    } else if (has_lens("fl_y") || has_lens("fl_x")) {
      // Nerfstudio: focal lengths in pixels; with one alone, pixels are square.
      const double focal_length = lens(has_lens("fl_y") ? "fl_y" : "fl_x");
      camera.fov_y_deg = 2.0 * std::atan2(lens("h"), 2.0 * focal_length) * kDegPerRad;
    } else {
      fail("says nothing of the camera's lens: expected camera_angle_x, or fl_y and h");
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
      // The target is the picture's centre; the eye's own is that of the sphere.
      camera.eye += camera.target - vector(member(scoring, "target"), "camera.target");
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

std::optional<double> parse_camera_aspect(std::string_view bytes, std::string_view name) {
  return CameraReader(bytes, name).aspect();
}

}  // namespace vantage
