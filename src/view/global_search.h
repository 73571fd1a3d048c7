// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"

namespace vantage {

/// The global search: the sphere is looked over by `estimates`, its peaks are climbed by them, and
/// exact scores decide between the places they lead to, look around the best of these and finish
/// the climb. Where the estimates are not the scores themselves, a peak is passed over only if its
/// estimate lies further below the best exact score than estimates have been seen to be wrong.
/// docs/search.md has the numbers.
/// \param exact scores. \param estimates cheaper ones of the same objective, or `exact` itself.
/// \param landmarks directions to look at whatever their neighbours say. \throw Cancelled
Candidate search_globally(Evaluator& exact, Evaluator& estimates, Goal goal,
                          const std::vector<Vec3>& landmarks, const RunContext& run);

}  // namespace vantage
