// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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
};

/// Rings of an ascent, radians.
struct RingWidths {
  double first_rad = 0.0;
  double last_rad = 0.0;  ///< No ring is narrower.
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
/// halves the ring if not, until a ring would be narrower than the last. All candidates advance
/// together, one batch a round; rounds are recorded as levels from `level` on. \throw Cancelled
void ascend(std::vector<Candidate>& candidates, const RingWidths& rings, const SearchTarget& target,
            int level, const RunContext& run);

}  // namespace vantage
