// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"

namespace vantage {

/// Lee, Varshney and Jacobs' search: from random directions up, or down, the gradient of the score,
/// the best of all ends. Their paper leaves numbers open: docs/search.md has those taken.
/// \param total the score if everything were visible. \throw Cancelled
Candidate search_by_gradient(Evaluator& evaluator, Goal goal, const SearchOptions& options,
                             double total, const RunContext& run);

}  // namespace vantage
