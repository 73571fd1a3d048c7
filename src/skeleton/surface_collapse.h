// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/contraction/history.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "skeleton/collapsed.h"

namespace vantage {

/// Share of each vertex in its cluster: its area, or the mean area where it has none; 1e-300 if none has any.
std::vector<double> cluster_weights(const TriMesh& mesh);

/// Sums of the weights of the vertices that are part of each of `count` nodes, or merged vertices.
std::vector<double> sums_of_parts(const std::vector<double>& weights,
                                  const std::vector<std::uint32_t>& part_of, std::size_t count);

/// Collapses a contracted surface where it is thinnest until a graph is left, each component by itself.
/// Where several of its handles have shrunk into one another there, the order of collapses is that of
/// the last level at which the fewest are lost; nodes stand at the mean of their vertices' thinnest
/// positions all the same. Vertices without faces are nodes.
/// \param spacing of the samples that the graph will have. \pre the history belongs to the mesh.
/// \throw Cancelled
Collapsed collapse_thinnest(const TriMesh& mesh, const ContractionHistory& history, double spacing,
                            const RunContext& run);

}  // namespace vantage
