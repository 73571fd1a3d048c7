// SPDX-License-Identifier: MIT
#include "vantage/view/search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/topology.h"

#include "view/evaluator.h"
#include "view/loop_patch.h"

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// Rapid search, with require_narrow_ring: a small gain stops it only within this ring. [ours]
constexpr double kNarrowRingRad = 2.0 * kDegree;
// Rapid search ends here in any case. [ours]
constexpr double kFinestRingRad = 0.001 * kDegree;
// Global search. [ours]
constexpr int kGlobalLevel = 3;
constexpr std::size_t kGlobalSeeds = 5;
constexpr int kDenseLevel = 5;
constexpr std::size_t kDenseSeeds = 3;
constexpr int kGlobalRing = 6;
// Half the spacing of the 642 directions, so that the first ring reaches between neighbours.
constexpr double kGlobalFirstStepRad = 4.0 * kDegree;
constexpr double kGlobalLastStepRad = 0.01 * kDegree;
// Share of the progress bar that the start set takes.
constexpr double kStartShare = 0.7;

/// The start set with its scores.
struct Start {
  DirectionSet set{};
  std::vector<double> scores{};
};

/// A direction and its score.
struct Candidate {
  Vec3 direction = Vec3::UnitZ();
  double score = 0.0;
};

/// What both goals need, whatever the strategy.
struct Search {
  Evaluator& evaluator;
  const Start& start;
  const SearchOptions& options;
  double total;
  Goal goal;
  RunContext run;

  [[nodiscard]] bool better(double a, double b) const { return goal == Goal::Best ? a > b : a < b; }

  /// A map that is zero everywhere: every view is as good as the first.
  [[nodiscard]] bool is_blank() const { return total == 0.0; }

  /// Index of the best of the scores; the lowest of equals.
  [[nodiscard]] std::size_t best_of(const std::vector<double>& scores) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < scores.size(); ++i) {
      if (better(scores[i], scores[best])) {
        best = i;
      }
    }
    return best;
  }
};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Candidate rapid(const Search& search) {
  const std::size_t first = search.best_of(search.start.scores);
  Candidate v0{search.start.set.directions[first], search.start.scores[first]};
  if (search.is_blank()) {
    return v0;
  }
  const double epsilon = search.options.epsilon_is_fraction ? search.options.epsilon * search.total
                                                            : search.options.epsilon;
  LoopPatch patch(search.start.set, static_cast<std::uint32_t>(first));
  double width = std::numbers::pi;
  for (int level = 1; width > kFinestRingRad; ++level) {
    // Each level halves the ring, so that the bar follows the logarithm of its width.
    search.run.advance(
        "search", std::log(std::numbers::pi / width) / std::log(std::numbers::pi / kFinestRingRad));
    patch.refine();
    const std::vector<Vec3> ring = patch.ring();
    const std::vector<double> scores = search.evaluator.scores(ring, level);
    const std::size_t best = search.best_of(scores);
    width = 0.0;
    for (const Vec3& d : ring) {
      width = std::max(width, angle_between(v0.direction, d));
    }
    const double gain = std::abs(v0.score - scores[best]);
    if (!search.better(v0.score, scores[best])) {
      v0 = {ring[best], scores[best]};
      patch.move_to(best);
    }
    if (gain < epsilon && (!search.options.require_narrow_ring || width < kNarrowRingRad)) {
      break;
    }
  }
  return v0;
}

/// Directions of the start set that none of their neighbours beats, best first; of equal
/// neighbours the lower index counts as better. At most kGlobalSeeds, kDenseSeeds of a dense set.
std::vector<Candidate> peaks(const Search& search) {
  const std::vector<double>& scores = search.start.scores;
  const auto ahead = [&](std::uint32_t a, std::uint32_t b) {
    return search.better(scores[a], scores[b]) || (scores[a] == scores[b] && a < b);
  };
  const IndexLists rings = vertex_neighbours(
      {.positions = search.start.set.directions, .triangles = search.start.set.triangles});
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < scores.size(); ++i) {
    const auto ring = rings[i];
    if (std::all_of(ring.begin(), ring.end(), [&](std::uint32_t j) { return ahead(i, j); })) {
      found.push_back(i);
    }
  }
  std::sort(found.begin(), found.end(), ahead);
  const bool dense = search.options.strategy == SearchStrategy::Dense;
  found.resize(std::min(found.size(), dense ? kDenseSeeds : kGlobalSeeds));
  std::vector<Candidate> result;
  result.reserve(found.size());
  for (const std::uint32_t i : found) {
    result.push_back({search.start.set.directions[i], scores[i]});
  }
  return result;
}

/// Directions at the angle `step` around `centre`.
std::vector<Vec3> ring_around(const Vec3& centre, double step_rad) {
  const Vec3 right = centre.unitOrthogonal();
  const Vec3 up = centre.cross(right);
  std::vector<Vec3> ring;
  for (int i = 0; i < kGlobalRing; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kGlobalRing;
    const Vec3 aside = std::cos(angle) * right + std::sin(angle) * up;
    const Vec3 direction = std::cos(step_rad) * centre + std::sin(step_rad) * aside;
    ring.push_back(direction.normalized());
  }
  return ring;
}

/// Moves each peak to the best of a ring around it, or halves the ring if none is better, until
/// the ring is narrower than kGlobalLastStepRad. All peaks advance together, in one batch a round.
Candidate global(const Search& search) {
  std::vector<Candidate> seeds = peaks(search);
  std::vector<double> steps(seeds.size(), kGlobalFirstStepRad);
  const auto unfinished = [&](std::size_t i) { return steps[i] >= kGlobalLastStepRad; };
  double done = 0.0;
  for (int level = 1; !search.is_blank(); ++level) {
    std::vector<Vec3> batch;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      if (unfinished(i)) {
        active.push_back(i);
        const std::vector<Vec3> ring = ring_around(seeds[i].direction, steps[i]);
        batch.insert(batch.end(), ring.begin(), ring.end());
      }
    }
    if (active.empty()) {
      break;
    }
    const double widest = *std::max_element(steps.begin(), steps.end());
    done = std::max(done, std::log(kGlobalFirstStepRad / widest) /
                              std::log(kGlobalFirstStepRad / kGlobalLastStepRad));
    search.run.advance("search", done);
    const std::vector<double> scores = search.evaluator.scores(batch, level);
    for (std::size_t k = 0; k < active.size(); ++k) {
      const auto begin = scores.begin() + static_cast<std::ptrdiff_t>(k * kGlobalRing);
      const std::size_t best = search.best_of({begin, begin + kGlobalRing});
      const Candidate found{batch[k * kGlobalRing + best], scores[k * kGlobalRing + best]};
      if (search.better(found.score, seeds[active[k]].score)) {
        seeds[active[k]] = found;
      } else {
        steps[active[k]] *= 0.5;
      }
    }
  }
  Candidate winner = seeds.front();
  for (const Candidate& seed : seeds) {
    if (search.better(seed.score, winner.score)) {
      winner = seed;
    }
  }
  return winner;
}

Candidate refine(const Search& search) {
  switch (search.options.strategy) {
    case SearchStrategy::Rapid:
      return rapid(search);
    case SearchStrategy::Global:
    case SearchStrategy::Dense:
      return global(search);
    case SearchStrategy::Exhaustive:
      break;
  }
  const std::size_t best = search.best_of(search.start.scores);
  return {search.start.set.directions[best], search.start.scores[best]};
}

Start evaluate_start(Evaluator& evaluator, const SearchOptions& options, const RunContext& run) {
  Start start;
  switch (options.strategy) {
    case SearchStrategy::Global:
      start.set = direction_set(ViewSphereBase::Icosahedron, kGlobalLevel);
      break;
    case SearchStrategy::Dense:
      start.set = direction_set(ViewSphereBase::Icosahedron, kDenseLevel);
      break;
    case SearchStrategy::Rapid:
    case SearchStrategy::Exhaustive:
      start.set = direction_set(options.base, options.subdivisions);
      break;
  }
  start.scores = evaluator.scores(start.set.directions, 0, run);
  return start;
}

void check_options(double total, const SearchOptions& options) {
  check_fields(options, kSearchFields);
  if (!(options.epsilon >= 0.0) || !std::isfinite(options.epsilon)) {
    throw InvalidInput("option epsilon must be finite and not negative");
  }
  if (!(total >= 0.0) || !std::isfinite(total)) {
    throw InvalidInput("the total score of a search must be finite and not negative");
  }
}

FoundView report(const Candidate& found, const std::vector<SearchStep>& trace, std::size_t begin) {
  FoundView view;
  view.direction = found.direction;
  view.score = found.score;
  view.trace.assign(trace.begin() + static_cast<std::ptrdiff_t>(begin), trace.end());
  view.evaluations = view.trace.size();
  return view;
}

}  // namespace

FoundView search_view(const ScoreBatch& score, double total, Goal goal,
                      const SearchOptions& options, const RunContext& run) {
  check_options(total, options);
  Evaluator evaluator(score);
  const Start start = evaluate_start(evaluator, options, run.part(0.0, kStartShare));
  const Candidate found =
      refine({evaluator, start, options, total, goal, run.part(kStartShare, 1.0)});
  run.advance("search", 1.0);
  return report(found, evaluator.trace(), 0);
}

FoundViews search_best_and_worst(const ScoreBatch& score, double total,
                                 const SearchOptions& options, const RunContext& run) {
  check_options(total, options);
  Evaluator evaluator(score);
  const double middle = 0.5 * (1.0 + kStartShare);
  const Start start = evaluate_start(evaluator, options, run.part(0.0, kStartShare));
  FoundViews views;
  const Candidate best =
      refine({evaluator, start, options, total, Goal::Best, run.part(kStartShare, middle)});
  views.best = report(best, evaluator.trace(), 0);
  const Candidate worst =
      refine({evaluator, start, options, total, Goal::Worst, run.part(middle, 1.0)});
  views.worst = report(worst, evaluator.trace(), views.best.trace.size());
  run.advance("search", 1.0);
  return views;
}

}  // namespace vantage
