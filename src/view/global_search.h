// SPDX-License-Identifier: MIT
#pragma once

#include "view/local_ascent.h"

namespace vantage {

/// Estimates over the sphere, exact values of the most promising directions, ascent from the best of
/// those (docs/search.md). \throw Cancelled
Candidate search_globally(const SearchTarget& target, const RunContext& run);

}  // namespace vantage
