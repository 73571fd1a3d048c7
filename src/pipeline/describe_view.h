// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/pipeline/find_views.h"

namespace vantage {

/// The camera of a picture of the whole surface from a direction.
Camera framed(const ShapeAnalysis& shape, const Vec3& direction, UpAxis up,
              const ViewOptions& options);

/// describe_view() with the score that the scorer gives, and the objective that options.prior makes
/// of it. \pre the scorer adds up options.weight.
ReportedView describe_scored_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                                  const ViewScorer& scorer, const Vec3& direction,
                                  const ModelFrame& frame, const ViewOptions& options);

}  // namespace vantage
