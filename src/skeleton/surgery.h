// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "vantage/core/run_context.h"

#include "skeleton/cluster_complex.h"

namespace vantage {

inline constexpr std::size_t kNeverGivenUp = std::numeric_limits<std::size_t>::max();

/// Collapses edges of `complex`, shortest first, until no triangle is left (Au 2008, section 5; Cao
/// 2010, section 4). An edge whose collapse pinches a loop waits until the loop is as short.
/// Returns how many collapses had to ignore the handle guard; 0 means that no handle was lost.
/// \param given_up_at where so many had to, triangles are left: for callers who have a better graph. \throw Cancelled
std::size_t collapse_to_graph(ClusterComplex& complex, const RunContext& run,
                              std::size_t given_up_at = kNeverGivenUp);

}  // namespace vantage
