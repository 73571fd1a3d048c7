// SPDX-License-Identifier: MIT
#include "pipeline/drawn_points.h"

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

/// Of the room that a margin leaves on each side, what the surroundings of a focus take. [ours]
constexpr double kSurroundings = 0.25;
/// Of the shape's diameter: pictures of less would show how its coordinates are rounded. [ours]
constexpr double kLeastFramed = 1e-4;

}  // namespace

std::vector<Vec3> drawn_points(const ShapeAnalysis& shape) {
  if (!shape.cloud) {
    return referenced_points(shape.surface);
  }
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < shape.surface.positions.size(); ++v) {
    if (shape.cloud->outlier[v] == 0) {
      points.push_back(shape.surface.positions[v]);
    }
  }
  return points;
}

FramedPoints framed_points(const ShapeAnalysis& shape, double margin_percent) {
  const double margin = margin_percent / 100.0;
  if (shape.focus.empty()) {
    return {drawn_points(shape), margin};
  }
  FramedPoints framed{{}, margin + kSurroundings * (0.5 - margin)};
  for (const std::uint32_t v : shape.focus) {
    framed.points.push_back(shape.surface.positions[v]);
  }
  const Sphere around = enclosing_sphere(framed.points);
  const double least = kLeastFramed * shape.sphere.diameter;
  if (around.diameter < least) {
    for (int axis = 0; axis < 3; ++axis) {
      framed.points.emplace_back(around.centre + 0.5 * least * Vec3::Unit(axis));
      framed.points.emplace_back(around.centre - 0.5 * least * Vec3::Unit(axis));
    }
  }
  return framed;
}

}  // namespace vantage
