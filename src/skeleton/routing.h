// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

#include "skeleton/shell.h"

namespace vantage {

/// A mesh, the node of each of its vertices, and what is inside it.
struct Routing {
  const TriMesh& mesh;
  std::span<const std::uint32_t> component_of_vertex;
  const Shell& shell;
};

/// Moves nodes that stand outside their component's shell to the first place inside: from `centred`
/// half way and all the way to where they stood in `raw`, else to the middle of the wall nearest to
/// where they should be.
CurveGraph move_nodes_inside(const CurveGraph& centred, const CurveGraph& raw,
                             const Routing& routing, std::span<const std::uint32_t> node_of_vertex);

/// Splits edges that leave the shell between two nodes inside it, at the middle of the wall nearest
/// to the edge's middle. New nodes take the vertices of both ends that are nearer to them; cycles and
/// components stay.
CurveGraph route_edges_inside(CurveGraph graph, const Routing& routing,
                              std::vector<std::uint32_t>& node_of_vertex);

}  // namespace vantage
