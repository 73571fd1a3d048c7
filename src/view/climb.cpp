// SPDX-License-Identifier: MIT
#include "view/climb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

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

std::vector<Candidate> ring_of(Candidate& candidate, double width_rad) {
  // Around the ring by 60° each.
  constexpr std::array<std::array<double, 2>, 6> kSteps{
      {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}, {1.0, -1.0}}};
  Foothold& at = candidate.foothold;
  if (at.width_rad == 0.0) {
    at = {candidate.direction, width_rad, 0.0, 0.0};
  }
  const Vec3 right = at.start.unitOrthogonal();
  const Vec3 up = at.start.cross(right);
  const double step = width_rad / at.width_rad;
  std::vector<Candidate> ring;
  ring.reserve(kSteps.size());
  for (const auto& [along, aslant] : kSteps) {
    Foothold next = at;
    next.along += step * along;
    next.aslant += step * aslant;
    const double x = next.along + 0.5 * next.aslant;
    const double y = 0.5 * std::numbers::sqrt3 * next.aslant;
    const Vec3 direction = at.start + at.width_rad * (x * right + y * up);
    const bool is_start = next.along == 0.0 && next.aslant == 0.0;
    ring.push_back({is_start ? at.start : direction.normalized(), 0.0, next});
  }
  return ring;
}

void climb(std::vector<Candidate>& candidates, Goal goal, const RingSteps& steps,
           const ScoreRings& score, int level, const RunContext& run) {
  std::vector<double> width(candidates.size(), steps.first_rad);
  double done = 0.0;
  for (;; ++level) {
    std::vector<Candidate> rings;
    std::vector<Vec3> directions;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (width[i] >= steps.last_rad) {
        active.push_back(i);
        for (Candidate& place : ring_of(candidates[i], width[i])) {
          directions.push_back(place.direction);
          rings.push_back(std::move(place));
        }
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
    const std::vector<double> scores = score(active, directions, level);
    for (std::size_t k = 0; k < rings.size(); ++k) {
      rings[k].score = scores[k];
    }
    const std::size_t ring_size = rings.size() / active.size();
    for (std::size_t k = 0; k < active.size(); ++k) {
      const auto begin = rings.begin() + static_cast<std::ptrdiff_t>(k * ring_size);
      const Candidate found =
          winner_of(goal, {begin, begin + static_cast<std::ptrdiff_t>(ring_size)});
      Candidate& here = candidates[active[k]];
      if (is_better(goal, found.score, here.score)) {
        here = found;
      } else {
        width[active[k]] *= 0.5;
      }
    }
  }
}

void climb(std::vector<Candidate>& candidates, Goal goal, const RingSteps& steps,
           Evaluator& evaluator, int level, const RunContext& run) {
  const ScoreRings score = [&](const std::vector<std::size_t>&, const std::vector<Vec3>& rings,
                               int at) { return evaluator.scores(rings, at); };
  climb(candidates, goal, steps, score, level, run);
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
