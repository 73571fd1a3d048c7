// SPDX-License-Identifier: MIT
#include "pipeline/map_coordinates.h"

#include <algorithm>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

// In the grids in use few places on land are nearer to the origin than this, in metres or feet.
constexpr double kFarAway = 1e4;
// A part modelled at its place in a machine may be some times its size away from the origin.
constexpr double kSizesAway = 10.0;
// No mountain is this part as high as the origin of its grid is away.
constexpr double kLow = 0.1;

}  // namespace

std::optional<UpAxis> up_of_map(const Model& model) {
  const bool is_stated =
      model.usual_up || model.format == ModelFormat::Gltf || model.format == ModelFormat::Glb;
  if (is_stated || model.mesh.positions.empty()) {
    return std::nullopt;
  }
  const Box box = bounding_box(referenced_points(model.mesh));
  const Vec3 away = (0.5 * (box.low + box.high)).cwiseAbs();
  const double far = std::max(kFarAway, kSizesAway * box.size().norm());
  const auto is_height = [&](double height, double a, double b) {
    return std::min(a, b) >= far && height <= kLow * std::min(a, b);
  };
  if (is_height(away.z(), away.x(), away.y())) {
    return UpAxis::Z;
  }
  return is_height(away.y(), away.x(), away.z()) ? std::optional(UpAxis::Y) : std::nullopt;
}

}  // namespace vantage
