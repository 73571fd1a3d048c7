// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"

namespace vantage {

/// How much the global search looks at. [ours, docs/search.md]
struct Effort {
  std::size_t promising;  ///< Directions of the first look around which it looks closer.
  std::size_t places;     ///< About so many are scored before the climb.
  std::size_t brinks;     ///< So many of the best brinks are scored.
  double finest_rad;      ///< The last ring is not narrower; at most 0.125°.
};

/// What the global search asks.
struct Guides {
  Evaluator& estimates;  ///< Look over the sphere; may be the exact scores.
  Evaluator& exact;      ///< Decide.
  Effort effort;
};

/// The global search: docs/search.md has the steps and the numbers. \throw Cancelled
Candidate search_globally(const Guides& guides, Goal goal, const SearchHints& hints,
                          const RunContext& run);

}  // namespace vantage
