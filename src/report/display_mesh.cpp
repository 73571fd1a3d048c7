// SPDX-License-Identifier: MIT
#include "report/display_mesh.h"

#include <algorithm>

#include <meshoptimizer.h>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

/// Each further try asks for this share of the faces of the last.
constexpr double kNextTry = 0.8;
/// When edges can no longer be collapsed, faces are clustered instead; then there is no more to try.
constexpr int kTries = 12;

std::vector<std::uint32_t> flat_indices(const TriMesh& surface) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    indices.insert(indices.end(), t.begin(), t.end());
  }
  return indices;
}

DisplayMesh compact(const std::vector<std::uint32_t>& indices) {
  DisplayMesh result;
  result.vertex_of_row = indices;
  std::sort(result.vertex_of_row.begin(), result.vertex_of_row.end());
  result.vertex_of_row.erase(std::unique(result.vertex_of_row.begin(), result.vertex_of_row.end()),
                             result.vertex_of_row.end());
  const auto row = [&](std::uint32_t v) {
    const auto at = std::lower_bound(result.vertex_of_row.begin(), result.vertex_of_row.end(), v);
    return static_cast<std::uint32_t>(at - result.vertex_of_row.begin());
  };
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    result.triangles.push_back({row(indices[i]), row(indices[i + 1]), row(indices[i + 2])});
  }
  return result;
}

}  // namespace

DisplayMesh display_mesh(const TriMesh& surface, std::size_t max_faces, std::size_t max_vertices) {
  const std::vector<std::uint32_t> all = flat_indices(surface);
  DisplayMesh result = compact(all);
  if (surface.triangles.size() <= max_faces && result.vertex_of_row.size() <= max_vertices) {
    return result;
  }
  // meshoptimizer works in float: around the origin, at unit size.
  const Box box = bounding_box(referenced_points(surface));
  const double scale = std::max(box.longest_side(), 1e-300);
  std::vector<float> points;
  points.reserve(3 * surface.positions.size());
  for (const Vec3& p : surface.positions) {
    const Vec3 unit = ((p - box.low) / scale).cwiseMax(0.0).cwiseMin(1.0);
    for (int axis = 0; axis < 3; ++axis) {
      points.push_back(static_cast<float>(unit[axis]));
    }
  }
  // A closed surface has about twice as many faces as vertices.
  auto wanted = static_cast<double>(std::min(max_faces, 2 * max_vertices));
  std::vector<std::uint32_t> indices(all.size());
  for (int attempt = 0; attempt < kTries; ++attempt, wanted *= kNextTry) {
    const std::size_t target = 3 * static_cast<std::size_t>(wanted);
    indices.resize(all.size());
    std::size_t count =
        meshopt_simplify(indices.data(), all.data(), all.size(), points.data(),
                         surface.positions.size(), 3 * sizeof(float), target, 1.0F, 0U, nullptr);
    if (count > target + target / 10) {  // seams and borders hold it up
      count = meshopt_simplifySloppy(indices.data(), all.data(), all.size(), points.data(),
                                     surface.positions.size(), 3 * sizeof(float), target, 1.0F,
                                     nullptr);
    }
    indices.resize(count);
    result = compact(indices);
    if (result.triangles.size() <= max_faces && result.vertex_of_row.size() <= max_vertices) {
      break;
    }
  }
  return result;
}

}  // namespace vantage
