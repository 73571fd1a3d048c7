// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "vantage/view/measure.h"
#include "vantage/view/search.h"

namespace vantage {

/// A measure of a view as a search takes it: a score that grows with how good the view is and is 0 or
/// more in the set of views. Where less is better, that is the largest finite value of the set less
/// the value; else the value, less the smallest one of the set if that is negative. The set is
/// estimated where the measure allows it and it was not looked at before.
class MeasureObjective {
 public:
  /// Estimates the set of views, or looks at it unless the measurer has. \param measurer must outlive this.
  /// \param m index into measurer.measures(). \throw Cancelled
  MeasureObjective(ViewMeasurer& measurer, std::size_t m, const RunContext& run = {});
  MeasureObjective(const MeasureObjective&) = delete;
  MeasureObjective& operator=(const MeasureObjective&) = delete;

  /// Refers to this.
  [[nodiscard]] ViewObjective objective() const;

  /// The score of a value, and back.
  [[nodiscard]] double score(double value) const;
  [[nodiscard]] double value(double score) const;

 private:
  [[nodiscard]] double floor() const { return std::min(0.0, lowest_); }

  void take(const std::vector<double>& of_set);
  [[nodiscard]] std::vector<double> scores(const std::vector<Vec3>& directions) const;

  ViewMeasurer* measurer_;
  std::size_t measure_;
  RunContext quiet_;
  bool is_falling_;
  std::map<std::array<double, 3>, double> of_set_{};
  bool has_estimates_ = false;  // of_set_ are
  double highest_ = 0.0;        // of the finite values of the set
  double lowest_ = 0.0;
};

}  // namespace vantage
