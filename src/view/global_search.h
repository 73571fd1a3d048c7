// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"

namespace vantage {

/// How many of the best places climb by rings of 1°, 0.5°, …; a 0 ends it.
using Climbs = std::array<std::size_t, 5>;

/// How much the global search looks at. [ours, docs/search.md]
struct Effort {
  std::size_t promising;  ///< Directions of the first look around which it looks closer.
  std::size_t places;     ///< About so many are scored at most before the climb.
  std::size_t brinks;     ///< So many of the best brinks are scored.
  Climbs to_best;
  Climbs to_worst;
  /// The last climb goes on to rings as narrow as this.
  double finest_rad = std::numeric_limits<double>::infinity();
};

/// What the global search asks.
struct Guides {
  Evaluator& estimates;  ///< Look over the sphere; may be the exact scores.
  Evaluator& exact;      ///< Decide.
  Effort effort;
  ScoreNearby nearby{};  ///< If there is one, hills are climbed by it, but for their first rings.
  std::function<void(const std::vector<Circles>&)> expect_nearby{};  ///< SearchHints::expect_nearby
};

/// The global search: docs/search.md has the steps and the numbers. \throw Cancelled
Candidate search_globally(const Guides& guides, Goal goal, const SearchHints& hints,
                          const RunContext& run);

}  // namespace vantage
