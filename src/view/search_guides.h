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
  double given_up =
      0.0;  ///< By so many doubts all must lie below the best to end the scoring of places.
  /// How many of the best climb by rings of 1°, 0.5°, …; a 0 ends it.
  std::array<std::size_t, 5> places{};
  /// By rings of 1° they climb one after the other, the best first, and only those that become the
  /// best if they gain so many times the scores' noise.
  double hope = std::numeric_limits<double>::infinity();
};

/// How much the global search looks at. [ours, docs/search.md]
struct Effort {
  std::size_t first_promising =
      0;                      ///< Directions of the first look around which it looks closer, …
  std::size_t promising = 0;  ///< … and of both around which it looks closer still.
  std::size_t hills = 0;      ///< All around the tops of so many is looked at, at a time.
  std::size_t marks = 0;      ///< Landmarks scored because estimates like them.
  std::size_t brinks = 0;     ///< So many of the best brinks are scored.
  std::size_t first = 0;      ///< Directions scored before anything is learnt.
  std::size_t prospects =
      1;                   ///< Of the best prospects so many are scored at a time from then on, …
  std::size_t scouts = 1;  ///< … and where they could be better by the most doubts so many.
  std::size_t places = 0;  ///< About so many are scored at most before the climb.
  Pursuit to_best{};
  Pursuit to_worst{};
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
