// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Splits edges at their middles until none is longer than a face at it allows, and faces along with
/// them, so that the surface stays the same and edges still fit. The vertices of `mesh` come first
/// and stay as they are.
/// \param longest longest edge of each face; infinity for no bound.
/// \return nothing if that takes more than `most_added` new vertices. \throw Cancelled
std::optional<TriMesh> split_long_edges(const TriMesh& mesh, std::vector<double> longest,
                                        std::size_t most_added, const RunContext& run);

}  // namespace vantage
