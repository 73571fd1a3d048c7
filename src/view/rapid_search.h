// SPDX-License-Identifier: MIT
#pragma once

#include "view/local_ascent.h"

namespace vantage {

/// The paper's search: from the best direction of a start set into rings of ever finer Loop
/// subdivisions of the view sphere around it. docs/search.md.
/// \param start values of `set`. \throw Cancelled
Candidate search_rapidly(const SearchTarget& target, const DirectionSet& set,
                         const std::vector<double>& start, const SearchOptions& options,
                         const RunContext& run);

}  // namespace vantage
