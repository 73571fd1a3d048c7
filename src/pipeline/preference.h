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
  Preference(const ShapeAnalysis& shape, const FrameChoice& choice, const ViewOptions& options,
             double total);

  /// How finely it is worth being searched, degrees.
  [[nodiscard]] double finest_deg() const;

  /// Whether it varies slowly with the direction; else it is as rough as the score.
  [[nodiscard]] bool is_smooth() const { return !fronts_.empty(); }

  /// Whether it is nothing but the score.
  [[nodiscard]] bool is_score() const;

  /// \param direction unit, model coordinates.
  [[nodiscard]] double operator()(const Vec3& direction, double score) const;

 private:
  /// One of the four sides that may be the front.
  struct Hypothesis {
    double probability = 1.0;
    UprightFrame frame{};
    ViewHabit habit;
  };

  /// Where people show things of such proportions, relative.
  [[nodiscard]] double habit(const Vec3& direction) const;

  const ViewOptions* options_;
  double total_;
  UprightFrame frame_;
  bool is_front_given_;
  double lapse_ = 0.0;              // what any direction counts besides
  std::vector<Hypothesis> fronts_;  // none: not what people choose
};

}  // namespace vantage
