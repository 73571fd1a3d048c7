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
      quiet_{.stop = run.stop, .max_threads = run.max_threads},
      is_falling_(measurer.measures()[m].better == Better::Less) {
  const std::vector<double>& values = measurer.set_values(run)[m];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3& d = measurer.set().directions[i];
    of_set_[{d.x(), d.y(), d.z()}] = values[i];
    highest_ = std::isfinite(values[i]) ? std::max(highest_, values[i]) : highest_;
  }
  highest_ = std::max(highest_, 0.0);
}

double MeasureObjective::score(double value) const {
  return is_falling_ ? highest_ - value : value;
}

double MeasureObjective::value(double score) const {
  return is_falling_ ? highest_ - score : score;
}

std::vector<double> MeasureObjective::scores(const std::vector<Vec3>& directions) const {
  std::vector<double> scores(directions.size(), 0.0);
  std::vector<Vec3> fresh;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3& d = directions[i];
    const auto known = of_set_.find({d.x(), d.y(), d.z()});
    if (known != of_set_.end()) {
      scores[i] = score(known->second);
    } else {
      fresh.push_back(d);
      index.push_back(i);
    }
  }
  const std::vector<double> values = measurer_->values_of(measure_, fresh, quiet_);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    scores[index[k]] = score(values[k]);
  }
  return scores;
}

ViewObjective MeasureObjective::objective() const {
  ViewObjective objective;
  objective.score = [this](const std::vector<Vec3>& directions) { return scores(directions); };
  objective.total = highest_;
  objective.survey_level = 3;  // that of the set, whose values are known
  objective.finest_deg = kFinestDeg;
  return objective;
}

}  // namespace vantage
