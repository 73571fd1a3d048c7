// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "vantage/core/vec3.h"
#include "vantage/mesh/curve_graph.h"

namespace vantage {

/// The graph with its edges cut into pieces and led through the middle of the contracted surface,
/// its ends reaching as far as that does: a polygonal principal curve (Kégl, Krzyżak, Linder, Zeger,
/// "Learning and Design of Principal Curves", PAMI 2000, doi:10.1109/34.841759) with the graph's
/// topology kept. Nodes of the graph keep their numbers; those inside edges follow.
/// \param contracted |V| points. \param weights one per point, ≥ 0.
/// \param node_of_vertex node of each point; others than nodes of the graph are left out.
/// \param piece longest piece of an edge, > 0; longer where that makes more than 100 000 and 4 a point.
CurveGraph fit_curve(const CurveGraph& graph, std::span<const Vec3> contracted,
                     std::span<const double> weights, std::span<const std::uint32_t> node_of_vertex,
                     double piece);

}  // namespace vantage
