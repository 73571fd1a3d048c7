// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/pipeline/find_views.h"

#include "pipeline/preference.h"

/// \file
/// The search for a report: of what mirror planes make as good as the best view, the one most toward
/// the front is taken, and the dense search is asked if it is to certify.

namespace vantage {

/// What was found and what else a report says of it.
struct SettledViews {
  FoundViews found{};                   ///< The best's trace has the highest's, too.
  std::vector<TwinView> twins{};        ///< None of a view that was given.
  std::optional<DenseGap> dense_gap{};  ///< If options.certify.
};

/// The views of an objective by `preference`. \throw Cancelled
SettledViews search_settled(const ViewObjective& objective, const Preference& preference,
                            const ShapeAnalysis& shape, const ModelFrame& frame,
                            const ViewOptions& options, const RunContext& run);

/// Of the best view and what mirror planes make of it, takes the one most toward the front, unless the
/// score alone counts. Counts those images as evaluations of the best that it and `worst` have not scored.
/// \return the others.
std::vector<TwinView> settle_on_the_front(FoundView& best, const FoundView& worst,
                                          const ViewObjective& objective,
                                          const Preference& preference, const ShapeAnalysis& shape,
                                          const ModelFrame& frame);

}  // namespace vantage
