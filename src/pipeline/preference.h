// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/pipeline/find_views.h"

#include "choice/view_habit.h"

namespace vantage {

/// What the best view maximises, of a direction and its score: see Objective.
class Preference {
 public:
  /// Refers to `options`. \param total of the scores: their share of it is what counts.
  /// \param estimates of scores, by which the choices that each possible front allows are weighed.
  Preference(const ShapeAnalysis& shape, const FrameChoice& choice, const ViewOptions& options,
             double total, const ScoreBatch& estimates);

  /// How finely it is worth being searched, degrees.
  [[nodiscard]] double finest_deg() const;

  /// Whether it is nothing but the score.
  [[nodiscard]] bool is_score() const;

  /// \param direction unit, model coordinates.
  [[nodiscard]] double operator()(const Vec3& direction, double score) const;

 private:
  void weigh_fronts(const ScoreBatch& estimates);
  [[nodiscard]] double power(double score) const;

  /// One of the four sides that may be the front.
  struct Hypothesis {
    double weight = 1.0;  ///< Its probability over what all views come to, if it is the front.
    UprightFrame frame{};
    ViewHabit habit;

    /// How near a direction is to what people take if this is the front, in (0, 1].
    [[nodiscard]] double habit_of(const Vec3& direction) const;
  };

  const ViewOptions* options_;
  double total_;
  UprightFrame frame_;
  std::vector<Hypothesis> fronts_;  // none: not what people choose
};

}  // namespace vantage
