// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/pipeline/find_views.h"
#include "vantage/view/measure.h"

namespace vantage {

/// Gives a view the camera and the size of its picture.
void frame_view(ReportedView& view, const ShapeAnalysis& shape, UpAxis up,
                const ViewOptions& options);

/// describe_view() with the score that the scorer gives, which is also its objective.
/// \pre the scorer adds up options.weight.
ReportedView describe_scored_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                                  const ViewScorer& scorer, const Vec3& direction,
                                  const ModelFrame& frame, const ViewOptions& options,
                                  const RunContext& run);

/// The share of the total that a score is; 0 of none, NaN of a measure, whose total is NaN.
double score_fraction(double score, double total);

/// Takes the best score that was found, unless the best view's is better still, into the report.
/// \pre report.best
void compare_with_highest(ViewReport& report, const Vec3& direction, double score, Better better);

}  // namespace vantage
