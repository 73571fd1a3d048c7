// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/pipeline/shape_analysis.h"

namespace vantage {

/// The vertices that pictures of the shape show, which they are framed by: those that faces name; of a
/// cloud all points but outliers, whether triangles join them or not.
std::vector<Vec3> drawn_points(const ShapeAnalysis& shape);

}  // namespace vantage
