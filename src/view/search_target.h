// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/search.h"

#include "core/parallel.h"
#include "view/score_memo.h"

namespace vantage {

/// What one search maximises: the preference for the best view, the negative score for the worst.
/// Two searches over one memo share what they score.
class SearchTarget {
 public:
  /// \param surrogate of the objective's surrogate; the same as `exact` if it has none.
  /// \param proxy of the objective's proxy; null if it has none.
  SearchTarget(const ViewObjective& objective, Goal goal, ScoreMemo& exact, ScoreMemo& surrogate,
               ScoreMemo* proxy = nullptr)
      : objective_(&objective),
        goal_(goal),
        exact_(&exact),
        surrogate_(&surrogate),
        proxy_(proxy) {}

  [[nodiscard]] bool has_proxy() const { return proxy_ != nullptr; }

  /// The same goal with the proxy's scores for the exact ones. \pre has_proxy()
  [[nodiscard]] SearchTarget by_proxy() const {
    return {*objective_, goal_, *proxy_, *surrogate_, nullptr};
  }

  /// Values of a few directions; new scores are recorded at `level`.
  [[nodiscard]] std::vector<double> values(const std::vector<Vec3>& directions, int level) const {
    return values_of(directions, exact_->scores(directions, level), {.max_threads = 1});
  }

  /// The same of a start set, with progress.
  [[nodiscard]] std::vector<double> values(const std::vector<Vec3>& directions,
                                           const RunContext& run) const {
    return values_of(directions, exact_->scores(directions, 0, run), run);
  }

  /// What the surrogate makes of them.
  [[nodiscard]] std::vector<double> estimates(const std::vector<Vec3>& directions,
                                              const RunContext& run) const {
    return values_of(directions, surrogate_->scores(directions, 0, run), run);
  }

  /// Whether every view is as good as any other.
  [[nodiscard]] bool is_flat() const {
    return objective_->total.has_value() && *objective_->total == 0.0;
  }

  /// Whether a preference, not the score, is maximised.
  [[nodiscard]] bool is_preference() const {
    return goal_ == Goal::Best && static_cast<bool>(objective_->preference);
  }

  /// Whether near a maximum there is nothing much better.
  [[nodiscard]] bool is_smooth() const {
    return is_preference() ? objective_->has_smooth_preference : objective_->has_smooth_score;
  }

  /// Of the global search's rings.
  [[nodiscard]] double finest_deg() const {
    return is_preference() ? objective_->finest_preferred_deg : objective_->finest_deg;
  }

  [[nodiscard]] const ViewObjective& objective() const { return *objective_; }

 private:
  static constexpr std::size_t kGrain = 32;  // directions: some tenths of a millisecond

  [[nodiscard]] std::vector<double> values_of(const std::vector<Vec3>& directions,
                                              std::vector<double> scores,
                                              const RunContext& run) const {
    parallel_for(run, scores.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (goal_ == Goal::Worst) {
          scores[i] = -scores[i];
        } else if (is_preference()) {
          scores[i] = objective_->preference(directions[i], scores[i]);
        }
      }
    });
    return scores;
  }

  const ViewObjective* objective_;
  Goal goal_;
  ScoreMemo* exact_;
  ScoreMemo* surrogate_;
  ScoreMemo* proxy_;
};

}  // namespace vantage
