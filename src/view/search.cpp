// SPDX-License-Identifier: MIT
#include "vantage/view/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "vantage/core/error.h"

#include "view/climb.h"
#include "view/evaluator.h"
#include "view/global_search.h"
#include "view/gradient_search.h"
#include "view/loop_patch.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// Rapid search, with require_narrow_ring: a small gain stops it only within this ring. [ours]
constexpr double kNarrowRingRad = 2.0 * kRadPerDeg;
// Rapid search ends here in any case. [ours]
constexpr double kFinestRingRad = 0.001 * kRadPerDeg;
// Dense search. [ours]
constexpr int kDenseLevel = 5;
constexpr std::size_t kDenseSeeds = 3;
constexpr RingSteps kDenseSteps{4.0 * kRadPerDeg, 0.01 * kRadPerDeg};
// Global search: usually; where scores are cheap; and where there is nothing cheaper than scores,
// so that the first look is at 2 562 directions. [ours, docs/search.md]
constexpr Effort kUsual{.first_promising = 25,
                        .promising = 30,
                        .hills = 2,
                        .marks = 3,
                        .brinks = 8,
                        .first = 9,
                        .prospects = 2,
                        .scouts = 2,
                        .places = 72,
                        .to_best = {.given_up = 2.7, .places = {4, 3, 2, 1, 1}, .hope = 0.5},
                        .to_worst = {.given_up = 2.3, .places = {3, 2, 1, 1, 0}, .hope = 1.5}};
constexpr Effort kThorough{.first_promising = 30,
                           .promising = 30,
                           .hills = 3,
                           .marks = 8,
                           .brinks = 150,
                           .first = 12,
                           .prospects = 2,
                           .scouts = 3,
                           .places = 288,
                           .to_best = {.given_up = 3.3, .places = {6, 4, 3, 2, 1}, .hope = 1.0},
                           .to_worst = {.given_up = 2.3, .places = {6, 4, 3, 2, 1}, .hope = 2.0}};
constexpr Effort kByScores{.first_promising = 162,
                           .promising = 642,
                           .hills = 3,
                           .marks = 8,
                           .brinks = 150,
                           .first = 12,
                           .prospects = 2,
                           .scouts = 3,
                           .places = 288,
                           .to_best = {.given_up = 3.0, .places = {6, 4, 3, 2, 1}},
                           .to_worst = {.given_up = 3.0, .places = {6, 4, 3, 2, 1}},
                           .finest_rad = 0.01 * kRadPerDeg};
// Share of the progress bar that the start set takes.
constexpr double kStartShare = 0.7;

/// The start set with its scores.
struct Start {
  DirectionSet set{};
  std::vector<double> scores{};
};

/// What both goals need, whatever the strategy.
struct Search {
  Evaluator& evaluator;
  const Start& start;
  const SearchOptions& options;
  double total;
  Goal goal;
  RunContext run;

  /// A map that is zero everywhere: every view is as good as the first.
  [[nodiscard]] bool is_blank() const { return total == 0.0; }
};

Candidate rapid(const Search& search) {
  const std::size_t first = best_of(search.goal, search.start.scores);
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
    const std::size_t best = best_of(search.goal, scores);
    width = 0.0;
    for (const Vec3& d : ring) {
      width = std::max(width, angle_between(v0.direction, d));
    }
    const double gain = std::abs(v0.score - scores[best]);
    if (!is_better(search.goal, v0.score, scores[best])) {
      v0 = {ring[best], scores[best]};
      patch.move_to(best);
    }
    if (gain < epsilon && (!search.options.require_narrow_ring || width < kNarrowRingRad)) {
      break;
    }
  }
  return v0;
}

/// Climbs from the best few peaks of the start set.
Candidate dense(const Search& search) {
  if (search.is_blank()) {
    return {search.start.set.directions.front(), search.start.scores.front()};
  }
  std::vector<Candidate> seeds =
      local_peaks(search.goal, search.start.set, search.start.scores, kDenseSeeds);
  climb(seeds, search.goal, kDenseSteps, search.evaluator, 1, search.run);
  return winner_of(search.goal, seeds);
}

Candidate refine(const Search& search) {
  switch (search.options.strategy) {
    case SearchStrategy::Rapid:
      return rapid(search);
    case SearchStrategy::Dense:
      return dense(search);
    case SearchStrategy::Gradient:
      return search_by_gradient(search.evaluator, search.goal, search.options, search.total,
                                search.run);
    case SearchStrategy::Global:  // has nothing to look for: every view is as good
    case SearchStrategy::Exhaustive:
      break;
  }
  const std::size_t best = best_of(search.goal, search.start.scores);
  return {search.start.set.directions[best], search.start.scores[best]};
}

Start evaluate_start(Evaluator& evaluator, const SearchOptions& options, const RunContext& run) {
  Start start;
  switch (options.strategy) {
    case SearchStrategy::Dense:
      start.set = direction_set(ViewSphereBase::Icosahedron, kDenseLevel);
      break;
    case SearchStrategy::Gradient:  // its starts are not a set
      return start;
    case SearchStrategy::Rapid:
    case SearchStrategy::Exhaustive:
    case SearchStrategy::Global:
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

/// What a search asks, and the record of it.
class Inquiry {
 public:
  Inquiry(const ScoreBatch& score, const SearchHints& hints)
      : exact_(score),
        estimates_(hints.estimate),
        nearby_(hints.nearby),
        expect_nearby_(hints.expect_nearby),
        has_estimates_(static_cast<bool>(hints.estimate)),
        is_thorough_(hints.scores_are_cheap) {}

  Evaluator& exact() { return exact_; }

  Guides guides() {
    ScoreNearby counted{};
    if (nearby_) {
      counted = [this](const Circles& circles, const std::vector<Vec3>& directions) {
        nearby_asked_ += directions.size();
        return nearby_(circles, directions);
      };
    }
    return {has_estimates_ ? estimates_ : exact_, exact_, effort(), std::move(counted),
            expect_nearby_};
  }

  /// What estimates were wrong by so far, but for directions that none is trusted with.
  [[nodiscard]] std::vector<KnownScore> lessons(std::span<const Vec3> brinks) const {
    return known_scores(estimates_, exact_, brinks);
  }

  /// Reports a view as found by all that was asked since the last report.
  FoundView report(const Candidate& found) {
    FoundView view;
    view.direction = found.direction;
    view.score = found.score;
    view.trace.assign(exact_.trace().begin() + static_cast<std::ptrdiff_t>(reported_),
                      exact_.trace().end());
    view.evaluations = view.trace.size();
    const std::size_t estimated = estimates_.trace().size() + nearby_asked_;
    view.estimates = estimated - estimates_reported_;
    reported_ = exact_.trace().size();
    estimates_reported_ = estimated;
    return view;
  }

 private:
  /// Scores by area, which come without nearby ones, are smooth: how much a climb gains is not told by
  /// the noise of what estimates them, and so all climb.
  [[nodiscard]] Effort effort() const {
    if (!has_estimates_) {
      return kByScores;
    }
    Effort effort = is_thorough_ ? kThorough : kUsual;
    if (!nearby_) {
      effort.to_best.hope = effort.to_worst.hope = std::numeric_limits<double>::infinity();
    }
    return effort;
  }

  Evaluator exact_;
  Evaluator estimates_;
  ScoreNearby nearby_;
  std::function<void(const std::vector<Circles>&)> expect_nearby_;
  std::size_t nearby_asked_ = 0;
  bool has_estimates_;
  bool is_thorough_;
  std::size_t reported_ = 0;
  std::size_t estimates_reported_ = 0;
};

/// Whether the global search has anything to look for.
bool is_global(double total, const SearchOptions& options) {
  return total > 0.0 && options.strategy == SearchStrategy::Global;
}

}  // namespace

FoundView search_view(const ScoreBatch& score, double total, Goal goal,
                      const SearchOptions& options, const RunContext& run,
                      const SearchHints& hints) {
  check_options(total, options);
  Inquiry inquiry(score, hints);
  Candidate found;
  if (is_global(total, options)) {
    found = search_globally(inquiry.guides(), goal, hints, run);
  } else {
    Evaluator& evaluator = inquiry.exact();
    const Start start = evaluate_start(evaluator, options, run.part(0.0, kStartShare));
    found = refine({evaluator, start, options, total, goal, run.part(kStartShare, 1.0)});
  }
  run.advance("search", 1.0);
  return inquiry.report(found);
}

FoundViews search_best_and_worst(const ScoreBatch& score, double total,
                                 const SearchOptions& options, const RunContext& run,
                                 const SearchHints& hints) {
  check_options(total, options);
  Inquiry inquiry(score, hints);
  FoundViews views;
  if (is_global(total, options)) {
    const Guides guides = inquiry.guides();
    views.best = inquiry.report(search_globally(guides, Goal::Best, hints, run.part(0.0, 0.6)));
    SearchHints taught = hints;
    const std::vector<KnownScore> lessons = inquiry.lessons(hints.brinks);
    taught.known.insert(taught.known.end(), lessons.begin(), lessons.end());
    views.worst = inquiry.report(search_globally(guides, Goal::Worst, taught, run.part(0.6, 1.0)));
  } else {
    Evaluator& evaluator = inquiry.exact();
    const double middle = 0.5 * (1.0 + kStartShare);
    const Start start = evaluate_start(evaluator, options, run.part(0.0, kStartShare));
    views.best = inquiry.report(
        refine({evaluator, start, options, total, Goal::Best, run.part(kStartShare, middle)}));
    views.worst = inquiry.report(
        refine({evaluator, start, options, total, Goal::Worst, run.part(middle, 1.0)}));
  }
  run.advance("search", 1.0);
  return views;
}

}  // namespace vantage
