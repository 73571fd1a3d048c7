// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/curve_graph.h"

namespace vantage {

/// Merges neighbouring nodes closer than `spacing`, nearest pair first, where no cycle is lost.
/// Ends and junctions stay where they are; other pairs meet at their weighted mean.
/// \param weight          share of each node in a mean.
/// \param node_of_vertex  mapped to the new nodes.
CurveGraph merge_close_nodes(const CurveGraph& graph, double spacing, std::vector<double> weight,
                             std::vector<std::uint32_t>& node_of_vertex);

}  // namespace vantage
