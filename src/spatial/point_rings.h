// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Neighbourhoods on a point cloud: Cao, Tagliasacchi, Olson, Zhang, Su, "Point Cloud Skeletons via
/// Laplacian-Based Contraction", SMI 2010, doi:10.1109/SMI.2010.25, section 3.

namespace vantage {

/// The Delaunay one-ring of each point among its nearest ones, projected on their PCA plane.
struct PointRings {
  IndexLists neighbours{};             ///< In angular order around the point.
  std::vector<std::uint8_t> closed{};  ///< 1 where the ring runs all the way round the point.

  /// Calls `visit(a, b)` for each triangle (point, a, b) of the point's star.
  template <class Visit>
  void each_triangle(std::size_t point, Visit&& visit) const {
    const auto ring = neighbours[point];
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      visit(ring[i], ring[i + 1]);
    }
    if (closed[point] != 0 && ring.size() > 2) {
      visit(ring.back(), ring.front());
    }
  }
};

/// [k] Points of a neighbourhood, the point itself counted: clamp(round(0.012 n), 8, 30) (Cao).
std::size_t neighbourhood_size(std::size_t point_count);

/// Finds the rings. Where four or more projected points lie on one empty circle within a relative
/// 1e-10, only those next to the centre are neighbours, whatever the order of the input.
/// \param points pairwise different, finite. \param k at least 3, the point itself counted.
/// \complexity O(n k log k) besides the search for the nearest points. \throw Cancelled
PointRings point_rings(std::span<const Vec3> points, std::size_t k, const RunContext& run = {});

/// How near the nearest points are.
struct NeighbourDistances {
  std::vector<double> mean{};                  ///< To the k nearest, model units.
  std::vector<double> median_of_neighbours{};  ///< Median of `mean` over those k.
};

/// Measures them. \param points pairwise different. \param k at least 1, the point not counted.
NeighbourDistances neighbour_distances(std::span<const Vec3> points, std::size_t k,
                                       const RunContext& run = {});

/// Triangles that the stars of at least `votes` (1 to 3) of their corners hold, each once, sorted.
std::vector<Triangle> agreed_triangles(const PointRings& rings, int votes);

/// For each point the nearest of `targets` and up to two more, ascending by distance, with weights
/// by inverse squared distance that add up to 1.
struct NearestThree {
  std::array<std::uint32_t, 3> index{};
  std::array<double, 3> weight{};
};

std::vector<NearestThree> nearest_three(std::span<const Vec3> points, std::span<const Vec3> targets,
                                        const RunContext& run = {});

/// Indices, ascending, of at most about `count` points that no two of are nearer than a common
/// distance, and that leave no point farther from them than that. All of them if they are no more.
std::vector<std::uint32_t> spread_sample(std::span<const Vec3> points, std::size_t count,
                                         const RunContext& run = {});

}  // namespace vantage
