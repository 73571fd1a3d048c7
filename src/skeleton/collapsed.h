// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "vantage/skeleton/skeleton.h"

#include "spatial/shell.h"

namespace vantage {

/// A graph straight from the collapse of a contracted surface or cloud.
struct Collapsed {
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};  ///< One of every vertex of the mesh.
  std::size_t lost_handles = 0;
};

/// What finish_skeleton() asks about the inside of the surface; null without faces. Mesh and history
/// must outlive it.
std::unique_ptr<const Shell> shell_to_finish(const TriMesh& mesh,
                                             const ContractionHistory& history);

/// Resamples it, which gives the raw graph, and centres, prunes and routes that.
/// \param shell of shell_to_finish(). \pre the history belongs to the mesh. \throw Cancelled
Skeleton finish_skeleton(const TriMesh& mesh, const ContractionHistory& history,
                         Collapsed collapsed, const Shell* shell, const SkeletonOptions& options,
                         const RunContext& run);

}  // namespace vantage
