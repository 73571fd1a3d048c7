// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

#include "skeleton/routing.h"

namespace vantage {

/// Takes tips that bend aside, as to a corner of a bolt's head, into the node before them: tips nearer to it than
/// `ratio` times its radius, and more than 45° off the way there. That node then lies in the middle of what both
/// stand for; where this is not straight ahead, as in a foot, or not inside, the tip stays. [ours]
/// \param node_of_vertex mapped to the remaining nodes.
CurveGraph take_in_bent_ends(const CurveGraph& graph, double ratio, const Routing& routing,
                             std::vector<std::uint32_t>& node_of_vertex);

}  // namespace vantage
