// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"

#include "core/json_text.h"
#include "io/byte_cursor.h"
#include "io/camera_axes.h"

namespace vantage {
namespace {

// glTF's codes: 32-bit float.
constexpr int kFloat = 5126;

/// Rotation of a node whose −z looks at the target and whose y is up.
Eigen::Quaterniond rotation_of(const Camera& camera) {
  return Eigen::Quaterniond(camera_axes(camera));
}

/// The buffer of an animation with the views and accessors that describe it.
class AnimationBuffer {
 public:
  /// Adds an array of `components` floats each; returns the accessor.
  int add(const std::vector<float>& values, int components, const char* type,
          const OrderedJson& low, const OrderedJson& high) {
    const std::size_t offset = bytes_.size();
    for (const float value : values) {
      append_little_endian(bytes_, value);
    }
    views_.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", 4 * values.size()}});
    OrderedJson accessor = {{"bufferView", views_.size() - 1},
                            {"componentType", kFloat},
                            {"count", values.size() / static_cast<std::size_t>(components)},
                            {"type", type}};
    if (!low.is_null()) {
      accessor["min"] = low;
      accessor["max"] = high;
    }
    accessors_.push_back(accessor);
    return static_cast<int>(accessors_.size()) - 1;
  }

  void store_in(OrderedJson& file) const {
    file["buffers"] =
        OrderedJson::array({{{"byteLength", bytes_.size()},
                             {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}});
    file["bufferViews"] = views_;
    file["accessors"] = accessors_;
  }

 private:
  std::string bytes_{};
  OrderedJson views_ = OrderedJson::array();
  OrderedJson accessors_ = OrderedJson::array();
};

/// Channels of the animation: where the eye is, and how the camera is turned, at each key.
OrderedJson animation_of(std::span<const Camera> cameras, double seconds, AnimationBuffer& buffer) {
  std::vector<float> times;
  std::vector<float> places;
  std::vector<float> turns;
  Eigen::Quaterniond last = rotation_of(cameras[0]);
  for (std::size_t i = 0; i <= cameras.size(); ++i) {
    const Camera& camera = cameras[i % cameras.size()];
    times.push_back(
        static_cast<float>(seconds * static_cast<double>(i) / static_cast<double>(cameras.size())));
    Eigen::Quaterniond turn = rotation_of(camera);
    if (turn.dot(last) < 0.0) {  // the same rotation; interpolation must not go the long way
      turn.coeffs() = -turn.coeffs();
    }
    last = turn;
    for (int k = 0; k < 3; ++k) {
      places.push_back(static_cast<float>(camera.eye[k]));
    }
    for (int k = 0; k < 4; ++k) {
      turns.push_back(static_cast<float>(turn.coeffs()[k]));  // x y z w, as glTF has them
    }
  }
  const int time = buffer.add(times, 1, "SCALAR", OrderedJson::array({times.front()}),
                              OrderedJson::array({times.back()}));
  const int place = buffer.add(places, 3, "VEC3", nullptr, nullptr);
  const int turn = buffer.add(turns, 4, "VEC4", nullptr, nullptr);
  const auto sampler = [time](int output) {
    return OrderedJson{{"input", time}, {"interpolation", "LINEAR"}, {"output", output}};
  };
  const auto channel = [](int index, const char* path) {
    return OrderedJson{{"sampler", index}, {"target", {{"node", 0}, {"path", path}}}};
  };
  return {{"name", "tour"},
          {"samplers", OrderedJson::array({sampler(place), sampler(turn)})},
          {"channels", OrderedJson::array({channel(0, "translation"), channel(1, "rotation")})}};
}

}  // namespace

std::string views_transforms_json(std::span<const NamedCamera> cameras) {
  OrderedJson file;
  OrderedJson frames = OrderedJson::array();
  for (const NamedCamera& named : cameras) {
    // What the file of one camera says of the whole file belongs to its frame here.
    const OrderedJson one =
        parsed_json(camera_transforms_json(named.camera, named.size, named.image_name));
    OrderedJson frame = one["frames"][0];
    for (const auto& [key, value] : one.items()) {
      if (key != "frames") {
        frame[key] = value;
      }
    }
    frames.push_back(frame);
  }
  const PictureSize first = cameras.empty() ? PictureSize{} : cameras.front().size;
  file["w"] = first.width;
  file["h"] = first.height;
  file["frames"] = frames;
  return json_text(file, 2) + "\n";
}

std::string camera_animation_gltf(std::span<const Camera> cameras, double seconds, PictureSize size,
                                  double near_far_scale) {
  if (cameras.size() < 2 || !(seconds > 0.0) || !std::isfinite(seconds)) {
    throw InvalidInput("a camera's animation needs at least two poses and some time");
  }
  OrderedJson file = parsed_json(camera_gltf(cameras[0], size, near_far_scale));
  const Eigen::Quaterniond turn = rotation_of(cameras[0]);
  const Vec3& eye = cameras[0].eye;
  OrderedJson& node = file["nodes"][0];
  node.erase("matrix");  // animated nodes must not have one
  node["translation"] = {eye.x(), eye.y(), eye.z()};
  node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  AnimationBuffer buffer;
  file["animations"] = OrderedJson::array({animation_of(cameras, seconds, buffer)});
  buffer.store_in(file);
  return json_text(file, 2) + "\n";
}

}  // namespace vantage
