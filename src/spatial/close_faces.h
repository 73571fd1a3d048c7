// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Faces near each other: what may meet.

namespace vantage {

/// Calls visit(f, g) for each pair f < g of faces whose boxes overlap or nearly do, found by boxes
/// around runs of faces: fast if faces near each other have numbers near each other.
/// \param mesh in a UnitFrame.
/// \param patience pairs visited and runs of boxes compared, at most: long slivers side by side could
///                 be nearly all pairs there are. A fine mesh takes some thirty a face.
/// \return false if there is more, of which nothing was visited.
bool for_each_close_pair(const TriMesh& mesh, std::size_t patience,
                         const std::function<void(std::uint32_t f, std::uint32_t g)>& visit);

}  // namespace vantage
