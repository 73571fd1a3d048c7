// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "vantage/view/search.h"

#include "view/evaluator.h"

/// \file
/// What the global search is given.

namespace vantage {

/// How long the search goes on to one end.
struct Pursuit {
  double given_up;  ///< By so many doubts all must lie below the best to end the scoring of places.
  /// How many of the best climb by rings of 1°, 0.5°, …; a 0 ends it.
  std::array<std::size_t, 5> places;
  /// By rings of 1° they climb one after the other, the best first, and only those that become the
  /// best if they gain so many times the scores' noise.
  double hope = std::numeric_limits<double>::infinity();
};

/// How much the global search looks at. [ours, docs/search.md]
struct Effort {
  std::size_t first_promising;  ///< Directions of the first look around which it looks closer, …
  std::size_t promising;        ///< … and of both around which it looks closer still.
  std::size_t hills;            ///< All around the tops of so many is looked at, at a time.
  std::size_t marks;            ///< Landmarks scored because estimates like them.
  std::size_t brinks;           ///< So many of the best brinks are scored.
  std::size_t first;            ///< Directions scored before anything is learnt.
  std::size_t prospects;  ///< Of the best prospects so many are scored at a time from then on, …
  std::size_t scouts;     ///< … and where they could be better by the most doubts so many.
  std::size_t places;     ///< About so many are scored at most before the climb.
  Pursuit to_best;
  Pursuit to_worst;
  /// The last climb goes on to rings as narrow as this.
  double finest_rad = std::numeric_limits<double>::infinity();

  [[nodiscard]] const Pursuit& to(Goal goal) const {
    return goal == Goal::Best ? to_best : to_worst;
  }
};

/// What the global search asks.
struct Guides {
  Evaluator& estimates;  ///< Look over the sphere; may be the exact scores.
  Evaluator& exact;      ///< Decide.
  Effort effort;
  ScoreNearby nearby{};  ///< If there is one, hills are climbed by it, but for their first rings.
  std::function<void(const std::vector<Circles>&)> expect_nearby{};  ///< SearchHints::expect_nearby
};

}  // namespace vantage
