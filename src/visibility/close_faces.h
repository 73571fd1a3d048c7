// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "visibility/surface.h"

/// \file
/// Faces near each other: what may meet.

namespace vantage {

/// Calls visit(f, g) for each pair f < g of faces whose boxes overlap or nearly do, found by boxes
/// around runs of faces, which are near each other because faces are in Morton order.
/// \param patience pairs visited and runs of boxes compared, at most: long slivers side by side could
///                 be nearly all pairs there are. A fine mesh takes some thirty a face.
/// \return false if there is more, of which nothing was visited.
bool for_each_close_pair(const Surface& surface, std::size_t patience,
                         const std::function<void(std::uint32_t f, std::uint32_t g)>& visit);

}  // namespace vantage
