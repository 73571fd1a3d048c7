// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"

namespace vantage {

/// The global search where a cheap estimate of the score is at hand: the sphere is looked over by
/// the estimate alone, its peaks are climbed by it, and exact scores decide between the places it
/// leads to and finish the climb. A peak is passed over only if its estimate lies further below the
/// best exact score than estimates have been seen to be wrong. docs/search.md has the numbers.
/// \param exact, estimates of the same objective. \throw Cancelled
Candidate search_by_estimates(Evaluator& exact, Evaluator& estimates, Goal goal,
                              const RunContext& run);

}  // namespace vantage
