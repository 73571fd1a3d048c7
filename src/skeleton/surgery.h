// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/core/run_context.h"

#include "skeleton/cluster_complex.h"

namespace vantage {

/// Collapses edges of `complex`, shortest first, until no triangle is left (Au 2008, section 5; Cao
/// 2010, section 4). An edge whose collapse pinches a loop waits until the loop is as short.
/// Returns how many collapses had to ignore the handle guard; 0 means that no handle was lost.
/// \throw Cancelled
std::size_t collapse_to_graph(ClusterComplex& complex, const RunContext& run);

}  // namespace vantage
