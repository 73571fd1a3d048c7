// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/skeleton/skeleton.h"

/// \file
/// How good a skeleton is, measured against its surface: the properties of Cornea et al. (2007)
/// that can be measured. docs/skeleton.md defines each number.

namespace vantage {

/// Measures of a finished skeleton. Lengths are in model units.
struct SkeletonQuality {
  double length = 0.0;          ///< Of all edges of closed components.
  double outside_length = 0.0;  ///< Of these, what is outside the own component's shell.
  double thin_outside = 0.0;    ///< Of that, on edges whose wall is thinner than r.
  std::size_t ends = 0;         ///< Nodes of one edge.
  double farthest_ratio =
      0.0;                  ///< Largest distance of a vertex to the graph over its node's radius.
  double farthest = 0.0;    ///< Largest distance of a vertex to the graph.
  double off_centre = 0.0;  ///< Mean over nodes: 1 − nearest / mean distance of its vertices.
  double seen_fraction = 0.0;  ///< Share of sampled vertices that the graph sees; 1 if all open.
};

/// Measures `skeleton.graph`. Where a component is open nothing is inside or outside: it counts in
/// `ends` and in the distances only.
/// \param component_of_vertex |V| labels.
/// \param thin walls below this, in model units, count as thin: r, the distance of samples.
SkeletonQuality measure_skeleton(const TriMesh& mesh,
                                 std::span<const std::uint32_t> component_of_vertex,
                                 const Skeleton& skeleton, double thin, const RunContext& run = {});

}  // namespace vantage
