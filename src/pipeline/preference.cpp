// SPDX-License-Identifier: MIT
#include "pipeline/preference.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/spatial/directions.h"

#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// Fronts less likely than this have no say. [ours]
constexpr double kLeastOdds = 0.01;
// Directions by which fronts are weighed: level of the icosahedron, 642, 8° apart. [ours]
constexpr int kWeighingLevel = 3;
// Shares of the score below this count as this: their logarithm is taken. [ours]
constexpr double kLeastShare = 1e-3;

Vec3 along(const UprightFrame& frame, const Vec3& direction) {
  return {frame.side.dot(direction), frame.up.dot(direction), frame.front.dot(direction)};
}

}  // namespace

Preference::Preference(const ShapeAnalysis& shape, const FrameChoice& choice,
                       const ViewOptions& options, double total, const ScoreBatch& estimates)
    : options_(&options), total_(total), frame_(upright_frame(choice.frame)) {
  if (objective_of(options) != Objective::People) {
    return;
  }
  const std::vector<MirrorPlane> planes = planes_of(shape);
  Vec3 front = frame_.front;
  for (const double odds : choice.orientation.front_odds) {
    if (odds >= kLeastOdds) {
      const UprightFrame frame = upright_frame(frame_.up, front);
      const ShapeProportions proportions =
          proportions_of(shape.surface, shape.sphere.diameter / 2.0, planes, frame);
      fronts_.push_back({odds, frame, ViewHabit(choice_table(), proportions)});
    }
    front = frame_.up.cross(front);
  }
  if (fronts_.size() > 1) {
    weigh_fronts(estimates);
  }
}

/// If a side is the front, what a person takes is a view's share of all views. So what can be seen
/// from around a side does not make it more likely to be the front.
void Preference::weigh_fronts(const ScoreBatch& estimates) {
  const std::vector<Vec3> directions =
      direction_set(ViewSphereBase::Icosahedron, kWeighingLevel).directions;
  std::vector<double> powers = estimates(directions);
  for (double& power_of : powers) {
    power_of = power(power_of);
  }
  std::vector<double> sums;
  double mean = 0.0;
  for (const Hypothesis& front : fronts_) {
    double sum = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      sum += front.habit_of(directions[i]) * powers[i];
    }
    sums.push_back(sum);
    mean += front.weight * sum;
  }
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    fronts_[k].weight *= sums[k] > 0.0 ? mean / sums[k] : 0.0;
  }
}

double Preference::power(double score) const {
  const double share = total_ > 0.0 ? score / total_ : 0.0;
  return std::pow(std::max(share, kLeastShare), choice_table().significance_weight);
}

double Preference::Hypothesis::habit_of(const Vec3& direction) const {
  return std::exp(-choice_table().habit_weight * habit.distance(along(frame, direction)));
}

double Preference::finest_deg() const {
  constexpr double kFinestScore = 0.01;   // scores have cusps
  constexpr double kFinestChoice = 0.25;  // choices of people are 10° apart
  return fronts_.empty() ? kFinestScore : kFinestChoice;
}

bool Preference::is_score() const {
  return fronts_.empty() && options_->prior.is_uniform;
}

double Preference::operator()(const Vec3& direction, double score) const {
  if (fronts_.empty()) {
    return score * options_->prior.factor(frame_, direction);
  }
  double habit = 0.0;
  for (const Hypothesis& front : fronts_) {
    habit += front.weight * front.habit_of(direction);
  }
  return habit * power(score);
}

}  // namespace vantage
