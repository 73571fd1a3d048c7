// SPDX-License-Identifier: MIT
#include "report/prior_search.h"

#include <utility>

#include "view/evaluator.h"

namespace vantage {

FoundViews search_under_prior(const ScoreBatch& score, double total, const ViewPrior& prior,
                              const UprightFrame& frame, const SearchOptions& options,
                              const RunContext& run, const SearchHints& hints) {
  if (prior.is_uniform) {
    return search_best_and_worst(score, total, options, run, hints);
  }
  Evaluator pure(score);
  Evaluator estimated(hints.estimate);
  const ScoreBatch remembered = [&](const std::vector<Vec3>& directions) {
    return pure.scores(directions, 0);
  };
  const auto weigh = [&](std::vector<double> values, const std::vector<Vec3>& directions) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] *= prior.factor(frame, directions[i]);
    }
    return values;
  };
  const ScoreBatch weighted = [&](const std::vector<Vec3>& directions) {
    return weigh(pure.scores(directions, 0), directions);
  };
  SearchHints plain = hints;
  SearchHints weighty = hints;
  if (hints.estimate) {
    plain.estimate = [&](const std::vector<Vec3>& directions) {
      return estimated.scores(directions, 0);
    };
    weighty.estimate = [&](const std::vector<Vec3>& directions) {
      return weigh(estimated.scores(directions, 0), directions);
    };
  }
  std::size_t nearby_asked = 0;
  if (hints.nearby) {
    plain.nearby = [&](const Circles& circles, const std::vector<Vec3>& directions) {
      nearby_asked += directions.size();
      return hints.nearby(circles, directions);
    };
    weighty.nearby = [&](const Circles& circles, const std::vector<Vec3>& directions) {
      return weigh(plain.nearby(circles, directions), directions);
    };
  }
  FoundViews views;
  views.best = search_view(weighted, total, Goal::Best, options, run.part(0.0, 0.8), weighty);
  for (SearchStep& step : views.best.trace) {
    step.score = pure.scores({step.direction}, 0).front();
  }
  views.best.score = pure.scores({views.best.direction}, 0).front();
  const std::size_t scored = pure.trace().size();
  const std::vector<KnownScore> lessons = known_scores(estimated, pure, hints.brinks);
  plain.known.insert(plain.known.end(), lessons.begin(), lessons.end());
  views.worst = search_view(remembered, total, Goal::Worst, options, run.part(0.8, 1.0), plain);
  views.worst.estimates = estimated.trace().size() + nearby_asked - views.best.estimates;
  // What the best view had scored before is not the worst view's cost.
  std::vector<SearchStep> fresh;
  std::size_t next = scored;
  for (const SearchStep& step : views.worst.trace) {
    if (next < pure.trace().size() && pure.trace()[next].direction == step.direction) {
      fresh.push_back(step);
      ++next;
    }
  }
  views.worst.trace = std::move(fresh);
  views.worst.evaluations = views.worst.trace.size();
  return views;
}

}  // namespace vantage
