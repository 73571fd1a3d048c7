// SPDX-License-Identifier: MIT
#include "report/display_mesh.h"

#include <algorithm>
#include <limits>

#include <meshoptimizer.h>

#include "vantage/mesh/measures.h"

#include "mesh/decimation.h"
#include "view/compact_surface.h"

namespace vantage {
namespace {

/// Each further try asks for this share of the faces of the last.
constexpr double kNextTry = 0.8;
/// When edges can no longer be collapsed, faces are clustered instead; then there is no more to try.
constexpr int kTries = 12;
/// A collapse where the significance is largest costs so much more: errors there are a fifth as long.
/// [ours]
constexpr double kPull = 24.0;

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
  if (indices.empty()) {
    return result;
  }
  std::vector<std::uint32_t> row_of(*std::max_element(indices.begin(), indices.end()) + 1, 0);
  for (const std::uint32_t v : indices) {
    row_of[v] = 1;
  }
  for (std::uint32_t v = 0; v < row_of.size(); ++v) {
    if (row_of[v] != 0) {
      row_of[v] = static_cast<std::uint32_t>(result.vertex_of_row.size());
      result.vertex_of_row.push_back(v);
    }
  }
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    result.triangles.push_back(
        {row_of[indices[i]], row_of[indices[i + 1]], row_of[indices[i + 2]]});
  }
  return result;
}

/// A copy by edge collapse: coarse vertices become the nearest of the vertices merged in them.
DisplayMesh collapsed(const CompactSurface& whole, const Decimation& coarse) {
  const std::vector<Vec3>& points = coarse.mesh.positions;
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> chosen(points.size(), 0);
  for (std::uint32_t row = 0; row < coarse.of_vertex.size(); ++row) {
    const std::uint32_t to = coarse.of_vertex[row];
    const double distance = (whole.mesh.positions[row] - points[to]).squaredNorm();
    if (distance < nearest[to]) {
      nearest[to] = distance;
      chosen[to] = whole.vertex_of_row[row];
    }
  }
  std::vector<std::uint32_t> indices;
  for (const Triangle& t : coarse.mesh.triangles) {
    for (const std::uint32_t v : t) {
      indices.push_back(chosen[v]);
    }
  }
  return compact(indices);
}

/// Factors of the cost of a collapse.
std::vector<double> collapse_weights(const CompactSurface& whole,
                                     std::span<const double> significance) {
  const double most = *std::max_element(significance.begin(), significance.end());
  std::vector<double> weights;
  for (const std::uint32_t v : whole.vertex_of_row) {
    weights.push_back(1.0 + (most > 0.0 ? kPull * significance[v] / most : 0.0));
  }
  return weights;
}

/// Copies by meshoptimizer, which takes any faces apart.
DisplayMesh clustered(const TriMesh& surface, const std::vector<std::uint32_t>& all,
                      std::size_t max_faces, std::size_t max_vertices) {
  DisplayMesh result;
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
  // A closed surface has about twice as many faces as vertices. A soup has a third as many: it may
  // have too many vertices and yet fewer faces than that, and meshoptimizer aborts when asked for more.
  auto wanted = static_cast<double>(std::min({max_faces, 2 * max_vertices, all.size() / 3}));
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

}  // namespace

std::vector<DisplayMesh> display_meshes(const TriMesh& surface,
                                        std::span<const double> significance,
                                        const std::vector<FaceSides>& sides,
                                        const std::array<DisplaySize, 2>& sizes,
                                        const RunContext& run) {
  const auto fits = [](const DisplayMesh& mesh, const DisplaySize& size) {
    return mesh.triangles.size() <= size.max_faces &&
           mesh.vertex_of_row.size() <= size.max_vertices;
  };
  // A closed surface has about twice as many faces as vertices.
  const auto target = [](const DisplaySize& size) {
    return std::min(size.max_vertices, size.max_faces / 2);
  };
  const std::vector<std::uint32_t> all = flat_indices(surface);
  const DisplayMesh whole = compact(all);
  std::vector<DisplayMesh> results(2, whole);
  if (fits(whole, sizes[1])) {
    return results;
  }
  const CompactSurface parts = compact_surface(surface, sides);
  const std::vector<double> weights = collapse_weights(parts, significance);
  if (fits(whole, sizes[0])) {
    results[1] = collapsed(parts, decimate(parts.mesh, target(sizes[1]), run, weights));
  } else {
    const TwoDecimations two =
        decimate_twice(parts.mesh, target(sizes[0]), target(sizes[1]), run, weights);
    results = {collapsed(parts, two.between), collapsed(parts, two.coarse)};
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!fits(results[i],
              sizes[i])) {  // soups and thousands of small parts have few edges to spare
      results[i] = clustered(surface, all, sizes[i].max_faces, sizes[i].max_vertices);
    }
  }
  return results;
}

}  // namespace vantage
