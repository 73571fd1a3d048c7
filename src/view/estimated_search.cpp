// SPDX-License-Identifier: MIT
#include "view/estimated_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vantage/spatial/directions.h"

#include "view/sphere_angles.h"

namespace vantage {
namespace {

// All ours, chosen on the models of docs/search.md: the fewest evaluations that found what a dense
// search finds.
constexpr int kLevel = 3;               // icosahedron level of the first look, 642 directions
constexpr std::size_t kPeaks = 40;      // at most so many peaks of the estimate are considered
constexpr std::size_t kFirstPeaks = 8;  // that are scored exactly whatever their estimate
constexpr std::size_t kFinalists = 3;   // that climb by exact scores
constexpr double kSameRad = 1.5 * kRadPerDeg;  // peaks nearer than this have climbed to the same
constexpr RingSteps kByEstimate{4.0 * kRadPerDeg, 1.0 * kRadPerDeg};
constexpr RingSteps kFinal{1.0 * kRadPerDeg, 0.5 * kRadPerDeg};
constexpr RingSteps kWinner{0.25 * kRadPerDeg, 0.05 * kRadPerDeg};

/// A place that the estimate led to.
struct Place {
  Vec3 direction = Vec3::UnitZ();
  double estimate = 0.0;
};

/// Peaks climbed by the estimate, each place once, best estimate first.
std::vector<Place> climbed_peaks(Evaluator& estimates, Goal goal, const RunContext& run) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kLevel);
  const std::vector<double> scores = estimates.scores(set.directions, 0, run.part(0.0, 0.6));
  std::vector<Candidate> peaks = local_peaks(goal, set, scores, kPeaks);
  climb(peaks, goal, kByEstimate, estimates, 1, run.part(0.6, 1.0));
  std::stable_sort(peaks.begin(), peaks.end(), [&](const Candidate& a, const Candidate& b) {
    return is_better(goal, a.score, b.score);
  });
  std::vector<Place> places;
  for (const Candidate& peak : peaks) {
    const bool known = std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return angle_between(place.direction, peak.direction) < kSameRad;
    });
    if (!known) {
      places.push_back({peak.direction, peak.score});
    }
  }
  return places;
}

/// Exact scores of the first places, and of all further ones that could still be better, given how
/// wrong the estimates were where both are known. Best first; those are left out that are worse than
/// the best by more than that error, which is also what their climb by estimates can have missed.
std::vector<Candidate> finalists(const std::vector<Place>& places, Evaluator& exact, Goal goal) {
  std::vector<Candidate> scored;
  double error = 0.0;
  const auto score_up_to = [&](std::size_t end) {
    std::vector<Vec3> directions;
    for (std::size_t i = scored.size(); i < end; ++i) {
      directions.push_back(places[i].direction);
    }
    const std::vector<double> scores = exact.scores(directions, 0);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      error = std::max(error, std::abs(scores[i] - places[scored.size()].estimate));
      scored.push_back({directions[i], scores[i]});
    }
  };
  score_up_to(std::min(kFirstPeaks, places.size()));
  const double best = winner_of(goal, scored).score;
  std::size_t end = scored.size();
  while (end < places.size() &&
         is_better(goal, places[end].estimate + (goal == Goal::Best ? error : -error), best)) {
    ++end;
  }
  score_up_to(end);
  std::stable_sort(scored.begin(), scored.end(), [&](const Candidate& a, const Candidate& b) {
    return is_better(goal, a.score, b.score);
  });
  const double bound = scored.front().score + (goal == Goal::Best ? -error : error);
  const auto hopeless = std::find_if(scored.begin() + 1, scored.end(), [&](const Candidate& c) {
    return is_better(goal, bound, c.score);
  });
  scored.erase(hopeless, scored.end());
  scored.resize(std::min(scored.size(), kFinalists));
  return scored;
}

}  // namespace

Candidate search_by_estimates(Evaluator& exact, Evaluator& estimates, Goal goal,
                              const RunContext& run) {
  const std::vector<Place> places = climbed_peaks(estimates, goal, run.part(0.0, 0.4));
  std::vector<Candidate> best = finalists(places, exact, goal);
  run.advance("search", 0.5);
  climb(best, goal, kFinal, exact, 1, run.part(0.5, 0.8));
  std::vector<Candidate> winner{winner_of(goal, best)};
  climb(winner, goal, kWinner, exact, 1, run.part(0.8, 1.0));
  return winner.front();
}

}  // namespace vantage
