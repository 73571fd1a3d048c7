// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/report/evaluation.h"

/// \file
/// The numbers of an evaluation, each of one view or map and what people did.

namespace vantage {

/// Names of rows: the view that the prior alone likes best, what is added to the name of a measure
/// whose scores were multiplied by the prior, and what `vantage view` finds.
inline constexpr std::string_view kPriorAlone = "prior alone";
inline constexpr std::string_view kUnderPrior = " × prior";
inline constexpr std::string_view kDefaultView = "vantage view";

/// Mean; NaN of nothing.
double mean_of(std::span<const double> values);

/// How near one direction is to people's; what is of people who moved is NaN where nobody did.
ViewAgreement agreement(const std::string& method, const RecordedModel& record,
                        const Vec3& direction);

/// Each person who moved against all the others; nothing if nobody moved.
std::optional<ViewAgreement> another_person(const RecordedModel& record);

/// The rows that methods are compared with: what people themselves and fixed cameras reach. The best
/// possible view and another person are left out where nobody moved.
std::vector<ViewAgreement> reference_rows(const RecordedModel& record, const DirectionSet& set,
                                          const UprightFrame& frame);

/// Mean share of the set's views that are no better than each view people chose; ties count half.
/// NaN if people chose none.
double human_percentile(const Measure& measure, std::span<const double> of_set,
                        std::span<const double> of_people);

/// The direction of the largest score × prior. Where less is better the score is how far a value
/// stays below the largest finite one.
Vec3 best_under_prior(const Measure& measure, const DirectionSet& set,
                      std::span<const double> values, const UprightFrame& frame);

/// Chance that a vertex of the twentieth of most gaze has a larger value than another one.
double roc_area(std::span<const double> map, std::span<const double> gaze);

}  // namespace vantage
