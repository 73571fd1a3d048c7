// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/report/view_report.h"

namespace vantage {

/// describe_view() with the score that the scorer gives, and the objective that options.prior makes
/// of it. \pre the scorer adds up options.weight.
ReportedView describe_scored_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                                  const ViewScorer& scorer, const Vec3& direction, UpAxis up,
                                  const ViewOptions& options);

}  // namespace vantage
