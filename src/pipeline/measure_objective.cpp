// SPDX-License-Identifier: MIT
#include "pipeline/measure_objective.h"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

// Measures are compared to a percent: no picture differs by less. [ours]
constexpr double kFinestDeg = 0.25;

}  // namespace

MeasureObjective::MeasureObjective(ViewMeasurer& measurer, std::size_t m, const RunContext& run)
    : measurer_(&measurer),
      measure_(m),
      quiet_(run.quiet()),
      is_falling_(measurer.measure(m).better == Better::Less) {
  const SetSurvey survey = measurer.survey_of(m, run);
  has_estimates_ = !survey.is_exact;
  take(survey.values);
  if (has_estimates_ && !(highest_ > 0.0)) {
    has_estimates_ = false;
    take(measurer.set_values(run)[m]);
  }
}

void MeasureObjective::take(const std::vector<double>& of_set) {
  highest_ = lowest_ = 0.0;
  bool is_first = true;
  for (std::size_t i = 0; i < of_set.size(); ++i) {
    const Vec3& d = measurer_->set().directions[i];
    of_set_[{d.x(), d.y(), d.z()}] = of_set[i];
    if (std::isfinite(of_set[i])) {
      highest_ = is_first ? of_set[i] : std::max(highest_, of_set[i]);
      lowest_ = is_first ? of_set[i] : std::min(lowest_, of_set[i]);
      is_first = false;
    }
  }
}

double MeasureObjective::score(double value) const {
  return is_falling_ ? highest_ - value : value - floor();
}

double MeasureObjective::value(double score) const {
  return is_falling_ ? highest_ - score : score + floor();
}

std::vector<double> MeasureObjective::scores(const std::vector<Vec3>& directions) const {
  std::vector<double> scores(directions.size(), 0.0);
  std::vector<Vec3> fresh;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3& d = directions[i];
    const auto known = of_set_.find({d.x(), d.y(), d.z()});
    if (!has_estimates_ && known != of_set_.end()) {
      scores[i] = score(known->second);
    } else {
      fresh.push_back(d);
      index.push_back(i);
    }
  }
  const std::vector<double> values = measurer_->kept_values_of(measure_, fresh, quiet_);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    scores[index[k]] = score(values[k]);
  }
  return scores;
}

ViewObjective MeasureObjective::objective() const {
  ViewObjective objective;
  objective.score = [this](const std::vector<Vec3>& directions) { return scores(directions); };
  if (has_estimates_) {
    objective.surrogate = [this](const std::vector<Vec3>& directions) {
      std::vector<double> estimates;
      estimates.reserve(directions.size());
      for (const Vec3& d : directions) {
        estimates.push_back(score(of_set_.at({d.x(), d.y(), d.z()})));
      }
      return estimates;
    };
  }
  const Measure& measure = measurer_->measure(measure_);
  // Near the maxima of a count, which are rough, many more views are scored than of areas.
  if (has_estimates_ || (measure.is_count && measurer_->has_estimates(measure_))) {
    objective.proxy = [this](const std::vector<Vec3>& directions) {
      std::vector<double> estimates = measurer_->estimates_of(measure_, directions, quiet_);
      for (double& estimate : estimates) {
        estimate = score(estimate);
      }
      return estimates;
    };
  }
  objective.total = highest_ - floor();
  objective.survey_level = measurer_->set_level();  // of which values are known
  objective.finest_deg = kFinestDeg;
  objective.has_smooth_score = measure.needs.faces && !measure.is_count;  // of areas
  return objective;
}

}  // namespace vantage
