// SPDX-License-Identifier: MIT
#pragma once

#include "view/local_ascent.h"

namespace vantage {

/// Lee, Varshney and Jacobs' search: from random directions along the gradient, the best of all
/// ends. Their paper leaves numbers open: docs/search.md has those taken. \throw Cancelled
Candidate search_by_gradient(const SearchTarget& target, const SearchOptions& options,
                             const RunContext& run);

}  // namespace vantage
