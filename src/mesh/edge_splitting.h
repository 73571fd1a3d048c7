// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Splits the edges of the chosen faces at their middles until none is longer than `longest`, and
/// faces along with them, so that the surface stays the same and edges still fit. The vertices of
/// `mesh` come first and stay as they are.
/// \param chosen one entry per face; an edge is split if some face at it is chosen. \throw Cancelled
TriMesh split_long_edges(const TriMesh& mesh, std::vector<bool> chosen, double longest,
                         const RunContext& run);

}  // namespace vantage
