// SPDX-License-Identifier: MIT
#include "pipeline/settled_search.h"

#include <algorithm>
#include <functional>

#include "core/unit_direction.h"
#include "pipeline/twins.h"

namespace vantage {
namespace {

/// With what was scored for the highest among what was for the best; without a preference they are one.
FoundViews with_all_scores(FoundViews found, const ViewObjective& objective) {
  if (objective.preference) {
    FoundView& best = found.best;
    best.trace.insert(best.trace.end(), found.highest.trace.begin(), found.highest.trace.end());
    best.evaluations += found.highest.evaluations;
    best.estimates += found.highest.estimates;
  }
  return found;
}

/// Compares what was found with a dense search of the same objective.
DenseGap gap_to_dense(const FoundViews& found, const ViewObjective& objective,
                      const RunContext& run) {
  const FoundViews dense = with_all_scores(
      search_best_and_worst(objective, {.strategy = SearchStrategy::Dense}, run), objective);
  const double range = dense.highest.score - dense.worst.score;
  DenseGap gap;
  gap.evaluations = dense.best.evaluations + dense.worst.evaluations;
  if (dense.best.preference > 0.0) {
    gap.best_ratio = found.best.preference / dense.best.preference;
  }
  if (range > 0.0) {
    gap.worst_above = (found.worst.score - dense.worst.score) / range;
  }
  return gap;
}

bool has(const FoundView& view, const Vec3& direction) {
  return std::any_of(view.trace.begin(), view.trace.end(),
                     [&](const SearchStep& step) { return step.direction == direction; });
}

/// Scores what `view` comes to beside its search, and counts what neither search has scored.
std::vector<double> scored_beside(const std::vector<Vec3>& directions, FoundView& view,
                                  const FoundView& other, const ViewObjective& objective) {
  std::vector<double> scores = objective.score(directions);
  const int level = view.trace.empty() ? 0 : view.trace.back().level;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!has(view, directions[i]) && !has(other, directions[i])) {
      view.trace.push_back({level, directions[i], scores[i]});
      ++view.evaluations;
    }
  }
  return scores;
}

}  // namespace

std::vector<TwinView> settle_on_the_front(FoundView& best, const FoundView& worst,
                                          const ViewObjective& objective,
                                          const Preference& preference, const ShapeAnalysis& shape,
                                          const ModelFrame& frame) {
  const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
    return scored_beside(directions, best, worst, objective);
  };
  std::vector<TwinView> twins = twins_of(best.direction, shape, score, preference);
  if (!preference.is_score()) {
    TwinView first{best.direction, best.score, best.preference};
    settle_near_ties(first, twins, upright_frame(frame));
    settle_sides(first, twins, upright_frame(frame), std::cref(preference));
    best.direction = first.direction;
    best.score = first.score;
    best.preference = first.objective;
  }
  return twins;
}

SettledViews search_settled(const ViewObjective& objective, const Preference& preference,
                            const ShapeAnalysis& shape, const ModelFrame& frame,
                            const ViewOptions& options, const RunContext& run) {
  SettledViews settled;
  FoundViews& found = settled.found;
  const double share = options.certify ? 0.25 : 1.0;  // of the bar
  found = with_all_scores(search_best_and_worst(objective, options.search, run.part(0.0, share)),
                          objective);
  if (options.best_view) {
    FoundView& best = found.best;
    best.direction = unit_direction(*options.best_view);
    best.score = scored_beside({best.direction}, best, found.worst, objective).front();
    best.preference = preference(best.direction, best.score);
  } else {
    settled.twins =
        settle_on_the_front(found.best, found.worst, objective, preference, shape, frame);
  }
  if (options.certify) {  // what is reported, and so not before near-ties are settled
    settled.dense_gap = gap_to_dense(found, objective, run.part(share, 1.0));
  }
  return settled;
}

}  // namespace vantage
