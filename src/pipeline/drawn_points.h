// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/pipeline/shape_analysis.h"

namespace vantage {

/// The vertices that pictures of the shape show, which they are framed by: those that faces name; of a
/// cloud all points but outliers, whether triangles join them or not.
std::vector<Vec3> drawn_points(const ShapeAnalysis& shape);

/// What pictures are framed by: the focus of the shape, or all that they show.
struct FramedPoints {
  std::vector<Vec3> points{};
  double margin = 0.0;  ///< Of the shorter side; wider around a focus.
};

/// \param margin_percent of options.
FramedPoints framed_points(const ShapeAnalysis& shape, double margin_percent);

}  // namespace vantage
