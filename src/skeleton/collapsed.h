// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/skeleton/skeleton.h"

namespace vantage {

/// A graph straight from the collapse of a contracted surface or cloud.
struct Collapsed {
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};  ///< One of every vertex of the mesh.
  std::size_t lost_handles = 0;
};

/// Resamples it, which gives the raw graph, and centres, prunes and routes that.
/// \pre the history belongs to the mesh.
Skeleton finish_skeleton(const TriMesh& mesh, const ContractionHistory& history,
                         Collapsed collapsed, const SkeletonOptions& options);

}  // namespace vantage
