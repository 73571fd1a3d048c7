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
// Shares of the score below this count as this: their logarithm is taken. [ours]
constexpr double kLeastShare = 1e-3;
// What a view counts from behind a front that was given: of 268 things of the catalogue whose front
// and back differ, people show 8 from there.
constexpr double kFromBehind = 0.03;
// The share of choices that follow no habit but what there is to see, from anywhere: of the catalogue's
// 404 one is shown from well below, where no habit leads, and below is half of the sphere. It decides
// where a habit shows next to nothing.
constexpr double kLapses = 2.0 / 404.0;
constexpr int kLapseSubdivisions = 2;  // 162 directions

Vec3 along(const UprightFrame& frame, const Vec3& direction) {
  return {frame.side.dot(direction), frame.up.dot(direction), frame.front.dot(direction)};
}

}  // namespace

Preference::Preference(const ShapeAnalysis& shape, const FrameChoice& choice,
                       const ViewOptions& options, double total)
    : options_(&options),
      total_(total),
      frame_(upright_frame(choice.frame)),
      is_front_given_(choice.orientation.front.source == "given") {
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
  const std::vector<Vec3> sphere =
      direction_set(ViewSphereBase::Icosahedron, kLapseSubdivisions).directions;
  for (const Vec3& direction : sphere) {
    lapse_ += kLapses * habit(direction) / static_cast<double>(sphere.size());
  }
}

double Preference::finest_deg() const {
  constexpr double kFinestScore = 0.01;   // scores have cusps
  constexpr double kFinestChoice = 0.25;  // choices of people are 10° apart
  return is_smooth() ? kFinestChoice : kFinestScore;
}

bool Preference::is_score() const {
  return fronts_.empty() && options_->prior.is_uniform;
}

double Preference::operator()(const Vec3& direction, double score) const {
  if (fronts_.empty()) {
    return score * options_->prior.factor(frame_, direction);
  }
  double chosen = habit(direction) + lapse_;
  if (is_front_given_ && direction.dot(frame_.front) < 0.0) {
    chosen *= kFromBehind;
  }
  const double share = total_ > 0.0 ? score / total_ : 0.0;
  return chosen * std::pow(std::max(share, kLeastShare), choice_table().significance_weight);
}

double Preference::habit(const Vec3& direction) const {
  double sum = 0.0;
  for (const Hypothesis& front : fronts_) {
    sum += front.probability * std::exp(-choice_table().habit_weight *
                                        front.habit.distance(along(front.frame, direction)));
  }
  return sum;
}

}  // namespace vantage
