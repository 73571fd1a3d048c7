// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vantage/spatial/directions.h"

#include "view/search_target.h"

/// \file
/// The local part of every search: peaks of a set of directions, and ascent from them by rings of
/// six that shrink.

namespace vantage {

/// A place on a triangular lattice in the tangent plane of a start direction. Halved steps are
/// steps of a finer lattice, so that a ring meets directions scored before to the bit.
struct LatticePlace {
  Vec3 start = Vec3::Zero();
  double width_rad = 0.0;  ///< Length of a step; 0 before the ascent.
  double along = 0.0;      ///< Steps along the first axis …
  double aslant = 0.0;     ///< … and along the second, at 60° to it.
};

/// A direction and its value.
struct Candidate {
  Vec3 direction = Vec3::UnitZ();
  double value = 0.0;
  LatticePlace place{};
  /// Range of the values on the last ring around it, its own included.
  double spread = std::numeric_limits<double>::infinity();
};

/// How an ascent goes on and ends.
struct AscentRules {
  double first_rad = 0.0;  ///< Radius of the first rings.
  double last_rad = 0.0;   ///< No ring is narrower.
  /// A ring on which the values differ by less ends the ascent: nothing is left to be gained.
  double flat = 0.0;
  /// Drops ascents that will hardly reach the best: a finer ring seldom gains more than the values of the last
  /// one differ by. Of two that converge the higher goes on.
  bool drops_losers = false;
};

/// Index of the largest value; the lowest of equals. \pre not empty.
std::size_t index_of_largest(const std::vector<double>& values);

/// Indices of the directions that none of their neighbours exceeds, largest value first; of equal
/// neighbours the lower index counts as larger.
std::vector<std::size_t> local_maxima(const DirectionSet& set, const std::vector<double>& values);

/// The largest `count` of the candidates, largest first, no two nearer to each other than an angle.
std::vector<Candidate> largest_apart(std::vector<Candidate> candidates, std::size_t count,
                                     double apart_rad);

/// Moves each candidate to the largest of the ring of six around it if that is strictly larger, and
/// halves the ring if not, until the rules end it. All candidates advance together, one batch a
/// round; rounds are recorded as levels from `level` on. \throw Cancelled
void ascend(std::vector<Candidate>& candidates, const AscentRules& rules,
            const SearchTarget& target, int level, const RunContext& run);

}  // namespace vantage
