// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Mean level-0 distance of each node to the vertices it stands for; a node without any takes the
/// mean of its neighbours.
std::vector<double> node_radii(const CurveGraph& graph, const TriMesh& mesh,
                               std::span<const std::uint32_t> node_of_vertex);

/// Moves every node to the area-weighted centroid of the vertices it stands for, then straightens
/// chains once, so that a slanted cluster does not leave a kink.
CurveGraph centre_nodes(const CurveGraph& graph, const TriMesh& mesh,
                        std::span<const std::uint32_t> node_of_vertex);

/// The graph without the nodes that others stand for; their edges to others go.
/// \param stands_for     of each node the one that takes its vertices, itself if it stays.
/// \param node_of_vertex mapped to the remaining nodes.
CurveGraph without_merged(const CurveGraph& graph, std::vector<std::uint32_t> stands_for,
                          std::vector<std::uint32_t>& node_of_vertex);

/// Cuts ends whose length is below `ratio` times the radius at the junction they hang from,
/// shortest first; their vertices go to the junction. Cycles and components stay.
/// \complexity O(n log n) for n nodes.
/// \param radius         |N| radii.
/// \param node_of_vertex mapped to the remaining nodes.
CurveGraph prune_ends(const CurveGraph& graph, double ratio, const std::vector<double>& radius,
                      std::vector<std::uint32_t>& node_of_vertex);

}  // namespace vantage
