// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/prior.h"
#include "vantage/view/search.h"

/// \file
/// The best view under a prior, the worst without.

namespace vantage {

/// search_best_and_worst() where the best view is that of the largest score × prior. All scores
/// that come back, those of the traces too, are pure; no direction is scored twice.
/// \param hints as for search_view(); the estimate is one of the score alone.
/// \throw InvalidInput, Cancelled
FoundViews search_under_prior(const ScoreBatch& score, double total, const ViewPrior& prior,
                              const UprightFrame& frame, const SearchOptions& options,
                              const RunContext& run, const SearchHints& hints = {});

}  // namespace vantage
