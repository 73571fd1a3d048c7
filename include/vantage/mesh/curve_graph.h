// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/topology.h"

namespace vantage {

/// A graph of straight segments embedded in space.
struct CurveGraph {
  std::vector<Vec3> nodes{};  ///< |N| points, in model units.
  std::vector<std::array<std::uint32_t, 2>>
      edges{};  ///< |E| pairs a < b, lexicographically sorted.
};

/// Number of connected components; isolated nodes count.
std::size_t component_count(const CurveGraph& graph);

/// Number of independent cycles, |E| − |N| + components.
std::size_t cycle_count(const CurveGraph& graph);

/// Number of edges at each node.
std::vector<std::uint32_t> node_degrees(const CurveGraph& graph);

/// The nodes that share an edge with each node, in the order of edges.
IndexLists node_neighbours(const CurveGraph& graph);

/// Nodes of two neighbours moved to ½ of their own place and ¼ of each neighbour's; others as they are.
/// \param positions |N| \param neighbours as node_neighbours() gives them.
std::vector<Vec3> smoothed_along_chains(std::span<const Vec3> positions,
                                        const IndexLists& neighbours);

/// The graph as polylines, each a run of node indices: from an end or junction to the next, or, where
/// a component is a plain loop, from its lowest node around to it again. Every edge is in exactly
/// one. Each run starts at the lower of its ends (of its second nodes, where it comes back to where it
/// began); runs are sorted. Nodes without edges are in none.
std::vector<std::vector<std::uint32_t>> graph_branches(const CurveGraph& graph);

/// Sum of the lengths of all edges.
double total_length(const CurveGraph& graph);

}  // namespace vantage
