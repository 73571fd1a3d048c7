// SPDX-License-Identifier: MIT
#include "view/pruned_search.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "vantage/spatial/directions.h"

#include "view/climb.h"
#include "view/evaluator.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// All ours: what a thumbnail shows changes little within a few degrees, and each costs time.
constexpr int kLevel = 2;               // icosahedron level of the first look, 162 directions
constexpr std::size_t kBatch = 16;      // directions scored before the bound is looked at again
constexpr std::size_t kPeaks = 3;       // peaks that are climbed
constexpr double kWorthClimbing = 0.9;  // share of the best that a peak must have
constexpr RingSteps kRings{8.0 * kRadPerDeg, 2.0 * kRadPerDeg};

}  // namespace

FoundView pruned_search(const ScoreBatch& score, double total, const DirectionFactor& factor,
                        const RunContext& run) {
  const ScoreBatch weighted = [&](const std::vector<Vec3>& directions) {
    std::vector<double> values = score(directions);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] *= factor(directions[i]);
    }
    return values;
  };
  Evaluator evaluator(weighted);
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kLevel);
  std::vector<double> factors;
  for (const Vec3& direction : set.directions) {
    factors.push_back(factor(direction));
  }
  std::vector<std::size_t> order(set.directions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return factors[a] > factors[b]; });
  // What is left out scores nothing, which is below the best and so no peak that matters.
  std::vector<double> values(set.directions.size(), 0.0);
  double best = -1.0;
  for (std::size_t begin = 0; begin < order.size() && total * factors[order[begin]] >= best;) {
    run.check();
    const std::size_t end = std::min(begin + kBatch, order.size());
    std::vector<Vec3> batch;
    for (std::size_t i = begin; i < end; ++i) {
      batch.push_back(set.directions[order[i]]);
    }
    const std::vector<double> scores = evaluator.scores(batch, 0);
    for (std::size_t i = begin; i < end; ++i) {
      values[order[i]] = scores[i - begin];
      best = std::max(best, scores[i - begin]);
    }
    begin = end;
  }
  FoundView found;
  if (total > 0.0) {
    std::vector<Candidate> peaks = local_peaks(Goal::Best, set, values, kPeaks);
    // Peaks of what was left out are no peaks, and low ones do not rise above the best.
    std::erase_if(peaks, [&](const Candidate& peak) { return peak.score < kWorthClimbing * best; });
    climb(peaks, Goal::Best, kRings, evaluator, 1, run);
    found.direction = winner_of(Goal::Best, peaks).direction;
  } else {
    found.direction = set.directions[best_of(Goal::Best, factors)];
  }
  found.score = score({found.direction}).front();
  found.trace = evaluator.trace();
  found.evaluations = found.trace.size();
  return found;
}

}  // namespace vantage
