// SPDX-License-Identifier: MIT
#include "vantage/view/search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/core/error.h"

#include "view/global_search.h"
#include "view/gradient_search.h"
#include "view/rapid_search.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// Dense search. [ours]
constexpr int kDenseLevel = 5;
constexpr std::size_t kDenseStarts = 3;
constexpr AscentRules kDenseRules{.first_rad = 4.0 * kRadPerDeg, .last_rad = 0.01 * kRadPerDeg};
// Share of the progress bar that a start set takes.
constexpr double kStartShare = 0.7;
constexpr int kMostSurveyLevel = 6;

/// Ascends from the highest peaks of the set.
Candidate search_densely(const SearchTarget& target, const DirectionSet& set,
                         const std::vector<double>& values, const RunContext& run) {
  std::vector<Candidate> peaks;
  for (const std::size_t i : local_maxima(set, values)) {
    if (peaks.size() < kDenseStarts) {
      peaks.push_back({set.directions[i], values[i]});
    }
  }
  ascend(peaks, kDenseRules, target, 1, run);
  return largest_apart(std::move(peaks), 1, 0.0).front();
}

Candidate search_from_a_set(const SearchTarget& target, const SearchOptions& options,
                            const RunContext& run) {
  const bool is_dense = options.strategy == SearchStrategy::Dense;
  const DirectionSet set = is_dense ? direction_set(ViewSphereBase::Icosahedron, kDenseLevel)
                                    : direction_set(options.base, options.subdivisions);
  const std::vector<double> values = target.values(set.directions, run.part(0.0, kStartShare));
  const RunContext rest = run.part(kStartShare, 1.0);
  if (options.strategy == SearchStrategy::Rapid && !target.is_flat()) {
    return search_rapidly(target, set, values, options, rest);
  }
  if (is_dense && !target.is_flat()) {
    return search_densely(target, set, values, rest);
  }
  const std::size_t first = index_of_largest(values);
  return {set.directions[first], values[first]};
}

Candidate search_for(const SearchTarget& target, const SearchOptions& options,
                     const RunContext& run) {
  switch (options.strategy) {
    case SearchStrategy::Gradient:
      return search_by_gradient(target, options, run);
    case SearchStrategy::Global:
      return target.is_flat() ? search_from_a_set(target, options, run)
                              : search_globally(target, run);
    case SearchStrategy::Rapid:
    case SearchStrategy::Exhaustive:
    case SearchStrategy::Dense:
      break;
  }
  return search_from_a_set(target, options, run);
}

void check_search(const ViewObjective& objective, const SearchOptions& options) {
  check_fields(options, kSearchFields);
  if (!objective.score) {
    throw InvalidInput("a search needs a score");
  }
  if (objective.starts == 0) {
    throw InvalidInput("a search starts its ascent from one direction at least");
  }
  if (!(objective.finest_deg > 0.0) || !(objective.finest_preferred_deg > 0.0)) {
    throw InvalidInput("the narrowest ring of a search must be wider than 0 degrees");
  }
  if (objective.survey_level < 0 || objective.survey_level > kMostSurveyLevel) {
    throw InvalidInput("a search surveys a set of level 0 to 6");
  }
  if (!(options.epsilon >= 0.0) || !std::isfinite(options.epsilon)) {
    throw InvalidInput("option epsilon must be finite and not negative");
  }
  const double total = objective.total.value_or(0.0);
  if (!(total >= 0.0) || !std::isfinite(total)) {
    throw InvalidInput("the total score of a search must be finite and not negative");
  }
}

/// The searches of one objective, with what they share.
class Searches {
 public:
  Searches(const ViewObjective& objective, const SearchOptions& options)
      : objective_(&objective), options_(&options) {
    check_search(objective, options);
  }

  FoundView find(Goal goal, const RunContext& run) {
    const std::size_t scored = exact_.trace().size();
    const std::size_t estimated = surrogate_.trace().size();
    const SearchTarget target(*objective_, goal, exact_,
                              objective_->surrogate ? surrogate_ : exact_,
                              objective_->proxy ? &proxy_ : nullptr);
    const Candidate found = search_for(target, *options_, run);
    run.advance("search", 1.0);
    FoundView view;
    view.direction = found.direction;
    view.score = exact_.scores({found.direction}, 0).front();
    view.preference = goal == Goal::Best ? found.value : view.score;
    view.trace.assign(exact_.trace().begin() + static_cast<std::ptrdiff_t>(scored),
                      exact_.trace().end());
    view.evaluations = view.trace.size();
    view.estimates = surrogate_.trace().size() - estimated;
    return view;
  }

 private:
  const ViewObjective* objective_;
  const SearchOptions* options_;
  ScoreMemo exact_{objective_->score};
  ScoreMemo surrogate_{objective_->surrogate};
  ScoreMemo proxy_{objective_->proxy};
};

}  // namespace

FoundView search_view(const ViewObjective& objective, Goal goal, const SearchOptions& options,
                      const RunContext& run) {
  return Searches(objective, options).find(goal, run);
}

FoundViews search_best_and_worst(const ViewObjective& objective, const SearchOptions& options,
                                 const RunContext& run) {
  Searches searches(objective, options);
  FoundViews views;
  const bool is_preference = static_cast<bool>(objective.preference);
  views.best = searches.find(Goal::Best, run.part(0.0, 0.5));
  views.highest = is_preference ? searches.find(Goal::Highest, run.part(0.5, 0.75)) : views.best;
  views.worst = searches.find(Goal::Worst, run.part(is_preference ? 0.75 : 0.5, 1.0));
  return views;
}

}  // namespace vantage
