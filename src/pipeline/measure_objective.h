// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <map>
#include <vector>

#include "vantage/view/measurer.h"
#include "vantage/view/prior.h"
#include "vantage/view/search.h"

namespace vantage {

/// A measure of a view as a search takes it: a score that grows with how good the view is. Where less
/// is better, that is the largest finite value of the set of views less the value.
class MeasureObjective {
 public:
  /// Looks at the set of views unless the measurer has. \param measurer must outlive this.
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
  [[nodiscard]] std::vector<double> scores(const std::vector<Vec3>& directions) const;

  ViewMeasurer* measurer_;
  std::size_t measure_;
  RunContext quiet_;
  bool is_falling_;
  std::map<std::array<double, 3>, double> of_set_{};
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace vantage
