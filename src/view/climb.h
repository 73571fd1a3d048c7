// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vantage/spatial/directions.h"
#include "vantage/view/search.h"

#include "view/evaluator.h"

/// \file
/// Steps that the searches of the whole sphere share: local peaks of a set, and climbing from them.

namespace vantage {

/// Where a climb is on a triangular lattice around its start, in steps of a width; halved steps
/// are steps of a finer lattice. So the ring around a place that was reached by a step holds places
/// scored before, to the bit.
struct Foothold {
  Vec3 start = Vec3::Zero();
  double width_rad = 0.0;  ///< 0 before the climb.
  double along = 0.0;      ///< Steps along the first way of the ring …
  double aslant = 0.0;     ///< … and along the second, at 60° to it.
};

/// A direction and its score.
struct Candidate {
  Vec3 direction = Vec3::UnitZ();
  double score = 0.0;
  Foothold foothold{};
};

/// Whether score `a` is strictly better than `b`.
inline bool is_better(Goal goal, double a, double b) {
  return goal == Goal::Best ? a > b : a < b;
}

/// Index of the best of the scores; the lowest of equals. \pre not empty.
std::size_t best_of(Goal goal, const std::vector<double>& scores);

/// Directions of the set that none of their neighbours beats, best first; of equal neighbours the
/// lower index counts as better. At most `count`.
std::vector<Candidate> local_peaks(Goal goal, const DirectionSet& set,
                                   const std::vector<double>& scores, std::size_t count);

/// From which ring to which, in radians.
struct RingSteps {
  double first_rad = 0.0;
  double last_rad = 0.0;  ///< The last ring is not narrower.
};

/// Scores the rings of some candidates, which are told by their index; all of one size.
using ScoreRings = std::function<std::vector<double>(const std::vector<std::size_t>& candidates,
                                                     const std::vector<Vec3>& rings, int level)>;

/// The ring of six around a candidate, on its lattice. The candidate gets a foothold if it has none.
std::vector<Candidate> ring_of(Candidate& candidate, double width_rad);

/// Moves each candidate to the best of a ring of six around it if that is strictly better, and
/// halves the ring if not, until the ring would be narrower than the last. All candidates advance
/// together, in one batch a round; rounds are recorded as levels from `level` on.
void climb(std::vector<Candidate>& candidates, Goal goal, const RingSteps& steps,
           const ScoreRings& score, int level, const RunContext& run);
void climb(std::vector<Candidate>& candidates, Goal goal, const RingSteps& steps,
           Evaluator& evaluator, int level, const RunContext& run);

/// The best of the candidates; the first of equals. \pre not empty.
Candidate winner_of(Goal goal, const std::vector<Candidate>& candidates);

}  // namespace vantage
