// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/pipeline/find_views.h"
#include "vantage/view/search.h"

#include "choice/view_habit.h"

namespace vantage {

/// What a search surveys the sphere by.
const ScoreBatch& surveyed_score(const ViewObjective& objective);

/// What the best view maximises, of a direction and its score: see Objective.
class Preference {
 public:
  /// Refers to `options`. \param total of the scores: their share of it is what counts.
  Preference(const ShapeAnalysis& shape, const FrameChoice& choice, const ViewOptions& options,
             double total);

  /// What there is to see tells nothing of where the front is: the views that go with each side that
  /// may be it count in all what the side's odds are, however much they show.
  /// \param score of views, as good as surveyed_score().
  void weigh_fronts(const ScoreBatch& score);

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
    double weight = 1.0;  // its odds, or by weigh_fronts()
    UprightFrame frame{};
    ViewHabit habit;

    /// Where people show things of such proportions that face this way, relative.
    [[nodiscard]] double at(const Vec3& direction) const;
  };

  /// Finds what any direction counts besides.
  void find_lapse();

  /// Where people show things of such proportions, relative.
  [[nodiscard]] double habit(const Vec3& direction) const;

  /// What a view counts by its score.
  [[nodiscard]] double shown(double score) const;

  const ViewOptions* options_;
  double total_;
  UprightFrame frame_;
  bool is_front_given_;
  double lapse_ = 0.0;              // what any direction counts besides
  std::vector<Hypothesis> fronts_;  // none: not what people choose
};

}  // namespace vantage
