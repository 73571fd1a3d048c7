// SPDX-License-Identifier: MIT
#include "view/global_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vantage/spatial/directions.h"

#include "view/sphere_angles.h"

namespace vantage {
namespace {

/// How much is looked at on the way. All ours, chosen on the models of docs/search.md: the fewest
/// evaluations that found what a dense search finds.
struct Effort {
  std::size_t peaks = 0;      ///< At most so many peaks of the first look are climbed.
  std::size_t landmarks = 0;  ///< So many of the best landmarks are climbed as well.
  std::size_t first = 0;      ///< Places that are scored exactly whatever their estimate.
  std::size_t finalists = 0;  ///< Places around which exact scores are looked for.
  std::size_t looks = 0;      ///< Directions around each that are scored exactly.
};

// Estimates cost little and mislead: many peaks, and each place looked at twice.
constexpr Effort kByEstimates{
    .peaks = 30, .landmarks = 8, .first = 12, .finalists = 3, .looks = 16};
constexpr Effort kByScores{.peaks = 6, .landmarks = 4, .first = 3, .finalists = 2, .looks = 20};

constexpr int kFirstLevel = 4;                    // of the first look: 2 562 directions, 4° apart
constexpr int kDenseLevel = 5;                    // of the look around: 2° apart
constexpr double kAroundRad = 12.0 * kRadPerDeg;  // how far that look goes
constexpr double kSameRad = 1.5 * kRadPerDeg;     // peaks nearer than this have climbed to the same
// The first ring is half the spacing of the first look, so that it reaches between neighbours.
constexpr RingSteps kFirstClimb{2.0 * kRadPerDeg, 1.0 * kRadPerDeg};
constexpr RingSteps kFinal{1.0 * kRadPerDeg, 0.5 * kRadPerDeg};
constexpr RingSteps kWinner{0.25 * kRadPerDeg, 0.01 * kRadPerDeg};

/// Which end is looked for, how hard, and by what.
struct Quest {
  Evaluator& exact;
  Evaluator& estimates;
  Goal goal;
  Effort effort;
};

void sort_best_first(std::vector<Candidate>& candidates, Goal goal) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [&](const Candidate& a, const Candidate& b) { return is_better(goal, a.score, b.score); });
}

/// The best few of the directions, best first.
std::vector<Candidate> best_few(const std::vector<Vec3>& directions, Evaluator& evaluator,
                                std::size_t count, Goal goal) {
  const std::vector<double> scores = evaluator.scores(directions, 1);
  std::vector<Candidate> ranked;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    ranked.push_back({directions[i], scores[i]});
  }
  sort_best_first(ranked, goal);
  ranked.resize(std::min(ranked.size(), count));
  return ranked;
}

/// Peaks and landmarks climbed by the estimate, each place once, best estimate first.
std::vector<Candidate> climbed_peaks(const Quest& quest, const std::vector<Vec3>& landmarks,
                                     const RunContext& run) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kFirstLevel);
  const std::vector<double> scores = quest.estimates.scores(set.directions, 0, run.part(0.0, 0.6));
  std::vector<Candidate> peaks = local_peaks(quest.goal, set, scores, quest.effort.peaks);
  for (const Candidate& landmark :
       best_few(landmarks, quest.estimates, quest.effort.landmarks, quest.goal)) {
    peaks.push_back(landmark);
  }
  climb(peaks, quest.goal, kFirstClimb, quest.estimates, 1, run.part(0.6, 1.0));
  sort_best_first(peaks, quest.goal);
  std::vector<Candidate> places;
  for (const Candidate& peak : peaks) {
    const bool known = std::any_of(places.begin(), places.end(), [&](const Candidate& place) {
      return angle_between(place.direction, peak.direction) < kSameRad;
    });
    if (!known) {
      places.push_back(peak);
    }
  }
  return places;
}

/// How exact scores differ from estimates where both are known.
struct Calibration {
  double shift = 0.0;  ///< Mean of score − estimate: a coarser copy sees a little more.
  double error = 0.0;  ///< Largest difference that is left then.
};

Calibration calibrate(const std::vector<Candidate>& places, const std::vector<Candidate>& scored) {
  Calibration result;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    result.shift += (scored[i].score - places[i].score) / static_cast<double>(scored.size());
  }
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const double left = scored[i].score - places[i].score - result.shift;
    result.error = std::max(result.error, std::abs(left));
  }
  return result;
}

/// Exact scores of the first places, and of all further ones that could still be better, given how
/// wrong the estimates were where both are known. The best few, best first.
/// \param places with their estimates, best first.
std::vector<Candidate> finalists(const std::vector<Candidate>& places, const Quest& quest) {
  std::vector<Candidate> scored;
  const auto score_up_to = [&](std::size_t end) {
    std::vector<Vec3> directions;
    for (std::size_t i = scored.size(); i < end; ++i) {
      directions.push_back(places[i].direction);
    }
    const std::vector<double> scores = quest.exact.scores(directions, 0);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      scored.push_back({directions[i], scores[i]});
    }
  };
  score_up_to(std::min(quest.effort.first, places.size()));
  const Calibration seen = calibrate(places, scored);
  const double margin = quest.goal == Goal::Best ? seen.error : -seen.error;
  const double best = winner_of(quest.goal, scored).score;
  std::size_t end = scored.size();
  while (end < places.size() &&
         is_better(quest.goal, places[end].score + seen.shift + margin, best)) {
    ++end;
  }
  score_up_to(end);
  sort_best_first(scored, quest.goal);
  scored.resize(std::min(scored.size(), quest.effort.finalists));
  return scored;
}

/// The best of a place and of the directions around it that the estimate likes best: hills are
/// rough, and a climb alone ends on the first bump.
Candidate best_around(const Candidate& place, const DirectionSet& dense, const Quest& quest) {
  std::vector<Vec3> near;
  for (const Vec3& d : dense.directions) {
    if (d.dot(place.direction) > std::cos(kAroundRad)) {
      near.push_back(d);
    }
  }
  std::vector<Vec3> chosen;
  for (const Candidate& liked : best_few(near, quest.estimates, quest.effort.looks, quest.goal)) {
    chosen.push_back(liked.direction);
  }
  const std::vector<Candidate> found = best_few(chosen, quest.exact, 1, quest.goal);
  return winner_of(quest.goal, {place, found.front()});
}

}  // namespace

Candidate search_globally(Evaluator& exact, Evaluator& estimates, Goal goal,
                          const std::vector<Vec3>& landmarks, const RunContext& run) {
  const Quest quest{exact, estimates, goal, &exact == &estimates ? kByScores : kByEstimates};
  std::vector<Candidate> best =
      finalists(climbed_peaks(quest, landmarks, run.part(0.0, 0.5)), quest);
  const DirectionSet dense = direction_set(ViewSphereBase::Icosahedron, kDenseLevel);
  for (Candidate& finalist : best) {
    run.advance("search", 0.6);
    finalist = best_around(finalist, dense, quest);
  }
  climb(best, goal, kFinal, exact, 2, run.part(0.7, 0.9));
  std::vector<Candidate> winner{winner_of(goal, best)};
  climb(winner, goal, kWinner, exact, 2, run.part(0.9, 1.0), &estimates);
  return winner.front();
}

}  // namespace vantage
