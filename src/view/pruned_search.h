// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "vantage/core/run_context.h"
#include "vantage/view/search.h"

namespace vantage {

/// A factor in (0, 1] of each direction.
using DirectionFactor = std::function<double(const Vec3&)>;

/// The direction of the largest factor · score among the 162 of icosahedron level 2, then refined
/// around the best few peaks to about a degree. Directions whose factor alone rules them out are
/// never scored: no score exceeds `total`.
/// The result's score is the pure one. \throw Cancelled
FoundView pruned_search(const ScoreBatch& score, double total, const DirectionFactor& factor,
                        const RunContext& run);

}  // namespace vantage
