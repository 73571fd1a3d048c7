// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/shell.h"

namespace vantage {

/// A mesh, the component of each of its vertices, and what is inside it.
struct Routing {
  const TriMesh& mesh;
  std::span<const std::uint32_t> component_of_vertex;
  const Shell& shell;
  RunContext run{};
};

/// The component of each node: that of any vertex of a node that hangs together with it; kNone if
/// there is none.
std::vector<std::uint32_t> components_of_nodes(const CurveGraph& graph,
                                               std::span<const std::uint32_t> node_of_vertex,
                                               std::span<const std::uint32_t> component_of_vertex);

/// Moves nodes that stand outside their component's shell to the first place inside: from `centred`
/// half way and all the way to where they stood in `raw`, else to the middle of the wall nearest to
/// where they should be.
CurveGraph move_nodes_inside(const CurveGraph& centred, const CurveGraph& raw,
                             const Routing& routing, std::span<const std::uint32_t> node_of_vertex);

/// Leads edges that leave the shell along a way inside (InteriorPaths). New nodes take the vertices of
/// both ends that are nearer to them; cycles and components stay. An edge for which no way is found
/// stays as it is.
CurveGraph route_edges_inside(CurveGraph graph, const Routing& routing,
                              std::vector<std::uint32_t>& node_of_vertex);

}  // namespace vantage
