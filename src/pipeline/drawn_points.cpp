// SPDX-License-Identifier: MIT
#include "pipeline/drawn_points.h"

#include "vantage/mesh/measures.h"

namespace vantage {

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

}  // namespace vantage
