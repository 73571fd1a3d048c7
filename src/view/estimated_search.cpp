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
constexpr int kLevel = 3;                // icosahedron level of the first look, 642 directions
constexpr std::size_t kPeaks = 40;       // at most so many peaks of the estimate are considered
constexpr std::size_t kFirstPeaks = 10;  // that are scored exactly whatever their estimate
constexpr std::size_t kFinalists = 2;    // places around which exact scores are looked for
constexpr int kDenseLevel = 5;           // icosahedron level of the look around them, 2° apart
constexpr double kAroundRad = 12.0 * kRadPerDeg;  // how far that look goes
constexpr std::size_t kLooks = 14;                // directions of it that are scored exactly
constexpr double kSameRad = 1.5 * kRadPerDeg;     // peaks nearer than this have climbed to the same
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

void sort_best_first(std::vector<Candidate>& candidates, Goal goal) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [&](const Candidate& a, const Candidate& b) { return is_better(goal, a.score, b.score); });
}

/// How exact scores differ from estimates where both are known.
struct Calibration {
  double shift = 0.0;  ///< Mean of score − estimate: a coarser copy sees a little more.
  double error = 0.0;  ///< Largest difference that is left then.
};

Calibration calibrate(const std::vector<Place>& places, const std::vector<Candidate>& scored) {
  Calibration result;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    result.shift += (scored[i].score - places[i].estimate) / static_cast<double>(scored.size());
  }
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const double left = scored[i].score - places[i].estimate - result.shift;
    result.error = std::max(result.error, std::abs(left));
  }
  return result;
}

/// Exact scores of the first places, and of all further ones that could still be better, given how
/// wrong the estimates were where both are known. The best few, best first; those are left out that
/// are worse than the best by more than that error, which is also what their climb can have missed.
std::vector<Candidate> finalists(const std::vector<Place>& places, Evaluator& exact, Goal goal) {
  std::vector<Candidate> scored;
  const auto score_up_to = [&](std::size_t end) {
    std::vector<Vec3> directions;
    for (std::size_t i = scored.size(); i < end; ++i) {
      directions.push_back(places[i].direction);
    }
    const std::vector<double> scores = exact.scores(directions, 0);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      scored.push_back({directions[i], scores[i]});
    }
  };
  score_up_to(std::min(kFirstPeaks, places.size()));
  const Calibration seen = calibrate(places, scored);
  const double margin = goal == Goal::Best ? seen.error : -seen.error;
  const double best = winner_of(goal, scored).score;
  std::size_t end = scored.size();
  while (end < places.size() && is_better(goal, places[end].estimate + seen.shift + margin, best)) {
    ++end;
  }
  score_up_to(end);
  sort_best_first(scored, goal);
  const double bound = scored.front().score - margin;
  const auto hopeless = std::find_if(scored.begin() + 1, scored.end(), [&](const Candidate& c) {
    return is_better(goal, bound, c.score);
  });
  scored.erase(hopeless, scored.end());
  scored.resize(std::min(scored.size(), kFinalists));
  return scored;
}

/// Exact scores of the directions around a place that the estimate likes best: hills are rough, and
/// a climb alone ends on the first bump.
void look_around(std::vector<Candidate>& candidates, const DirectionSet& dense, const Vec3& centre,
                 Evaluator& exact, Evaluator& estimates, Goal goal) {
  std::vector<Vec3> near;
  for (const Vec3& d : dense.directions) {
    if (d.dot(centre) > std::cos(kAroundRad)) {
      near.push_back(d);
    }
  }
  const std::vector<double> values = estimates.scores(near, 1);
  std::vector<Candidate> ranked;
  for (std::size_t i = 0; i < near.size(); ++i) {
    ranked.push_back({near[i], values[i]});
  }
  sort_best_first(ranked, goal);
  std::vector<Vec3> chosen;
  for (std::size_t i = 0; i < std::min(kLooks, ranked.size()); ++i) {
    chosen.push_back(ranked[i].direction);
  }
  const std::vector<double> scores = exact.scores(chosen, 1);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    candidates.push_back({chosen[i], scores[i]});
  }
}

}  // namespace

Candidate search_by_estimates(Evaluator& exact, Evaluator& estimates, Goal goal,
                              const RunContext& run) {
  const std::vector<Place> places = climbed_peaks(estimates, goal, run.part(0.0, 0.4));
  std::vector<Candidate> best = finalists(places, exact, goal);
  run.advance("search", 0.5);
  const DirectionSet dense = direction_set(ViewSphereBase::Icosahedron, kDenseLevel);
  for (const Candidate& finalist : std::vector<Candidate>(best)) {
    look_around(best, dense, finalist.direction, exact, estimates, goal);
  }
  sort_best_first(best, goal);
  best.resize(std::min(best.size(), kFinalists));
  climb(best, goal, kFinal, exact, 2, run.part(0.7, 0.9));
  std::vector<Candidate> winner{winner_of(goal, best)};
  climb(winner, goal, kWinner, exact, 2, run.part(0.9, 1.0), &estimates);
  return winner.front();
}

}  // namespace vantage
