// SPDX-License-Identifier: MIT
#include "view/climb.h"

#include <algorithm>
#include <cmath>

#include "vantage/mesh/topology.h"

#include "view/sphere_angles.h"

namespace vantage {

std::size_t best_of(Goal goal, const std::vector<double>& scores) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < scores.size(); ++i) {
    if (is_better(goal, scores[i], scores[best])) {
      best = i;
    }
  }
  return best;
}

std::vector<Candidate> local_peaks(Goal goal, const DirectionSet& set,
                                   const std::vector<double>& scores, std::size_t count) {
  const auto ahead = [&](std::uint32_t a, std::uint32_t b) {
    return is_better(goal, scores[a], scores[b]) || (scores[a] == scores[b] && a < b);
  };
  const IndexLists rings =
      vertex_neighbours({.positions = set.directions, .triangles = set.triangles});
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < scores.size(); ++i) {
    const auto ring = rings[i];
    if (std::all_of(ring.begin(), ring.end(), [&](std::uint32_t j) { return ahead(i, j); })) {
      found.push_back(i);
    }
  }
  std::sort(found.begin(), found.end(), ahead);
  found.resize(std::min(found.size(), count));
  std::vector<Candidate> result;
  result.reserve(found.size());
  for (const std::uint32_t i : found) {
    result.push_back({set.directions[i], scores[i]});
  }
  return result;
}

void climb(std::vector<Candidate>& candidates, Goal goal, const RingSteps& steps,
           Evaluator& evaluator, int level, const RunContext& run) {
  std::vector<double> width(candidates.size(), steps.first_rad);
  double done = 0.0;
  for (;; ++level) {
    std::vector<Vec3> batch;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (width[i] >= steps.last_rad) {
        active.push_back(i);
        const std::vector<Vec3> ring = ring_around(candidates[i].direction, width[i]);
        batch.insert(batch.end(), ring.begin(), ring.end());
      }
    }
    if (active.empty()) {
      return;
    }
    const double widest = *std::max_element(width.begin(), width.end());
    // Each round halves the ring, or moves: the bar follows the logarithm of the widest.
    done = std::max(done, std::log(steps.first_rad / widest) /
                              std::log(2.0 * steps.first_rad / steps.last_rad));
    run.advance("search", done);
    const std::vector<double> scores = evaluator.scores(batch, level);
    const std::size_t ring_size = batch.size() / active.size();
    for (std::size_t k = 0; k < active.size(); ++k) {
      const auto begin = scores.begin() + static_cast<std::ptrdiff_t>(k * ring_size);
      const std::size_t best =
          best_of(goal, {begin, begin + static_cast<std::ptrdiff_t>(ring_size)});
      Candidate& here = candidates[active[k]];
      const Candidate found{batch[k * ring_size + best], scores[k * ring_size + best]};
      if (is_better(goal, found.score, here.score)) {
        here = found;
      } else {
        width[active[k]] *= 0.5;
      }
    }
  }
}

Candidate winner_of(Goal goal, const std::vector<Candidate>& candidates) {
  Candidate winner = candidates.front();
  for (const Candidate& candidate : candidates) {
    if (is_better(goal, candidate.score, winner.score)) {
      winner = candidate;
    }
  }
  return winner;
}

}  // namespace vantage
