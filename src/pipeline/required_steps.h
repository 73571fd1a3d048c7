// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/error.h"
#include "vantage/pipeline/shape_analysis.h"

/// \file
/// What a shape must have got before it is looked at.

namespace vantage {

/// \throw InvalidInput that names the missing step if the shape has no map.
inline void require_map(const ShapeAnalysis& shape) {
  if (shape.significance.size() != shape.surface.positions.size()) {
    throw InvalidInput(
        "the shape has no significance map: call add_map() or analyse_shape() first");
  }
}

/// The same of its skeleton.
inline void require_skeleton(const ShapeAnalysis& shape) {
  if (shape.skeleton.graph.nodes.empty()) {
    throw InvalidInput("the shape has no skeleton: call add_skeleton() or analyse_shape() first");
  }
}

}  // namespace vantage
