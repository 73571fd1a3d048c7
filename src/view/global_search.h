// SPDX-License-Identifier: MIT
#pragma once

#include "view/climb.h"
#include "view/search_guides.h"

namespace vantage {

/// The global search: docs/search.md has the steps and the numbers. \throw Cancelled
Candidate search_globally(const Guides& guides, Goal goal, const SearchHints& hints,
                          const RunContext& run);

}  // namespace vantage
