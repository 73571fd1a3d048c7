// SPDX-License-Identifier: MIT
#include "pipeline/settled_search.h"

#include <utility>

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

}  // namespace

std::vector<TwinView> settle_on_the_front(FoundView& best, const ViewObjective& objective,
                                          const Preference& preference, const ShapeAnalysis& shape,
                                          const ModelFrame& frame) {
  std::vector<TwinView> twins = twins_of(best.direction, shape, objective.score, preference);
  if (!preference.is_score()) {
    TwinView first{best.direction, best.score, best.preference};
    settle_near_ties(first, twins, upright_frame(frame));
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
    best.direction = *options.best_view;
    best.score = objective.score({best.direction}).front();
    best.preference = preference(best.direction, best.score);
  } else {
    settled.twins = settle_on_the_front(found.best, objective, preference, shape, frame);
  }
  if (options.certify) {  // what is reported, and so not before near-ties are settled
    settled.dense_gap = gap_to_dense(found, objective, run.part(share, 1.0));
  }
  return settled;
}

}  // namespace vantage
