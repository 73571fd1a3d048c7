// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/shape_analysis.h"

#include "mesh/specks.h"
#include "pipeline/prepare_points.h"

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

/// \throw InvalidInput if it is a surface of which no view shows anything, as its faces have no area beyond
/// what rounding makes of none.
inline void require_view(const ShapeAnalysis& shape, const std::string& name) {
  constexpr double kNoArea = 1e-12;  // of D², as check_mesh() has it of a face
  const double diameter = shape.sphere.diameter;
  if (!shape.cloud && shape.check.zero_area_faces >= shape.surface.triangles.size() &&
      surface_area(shape.surface) <= kNoArea * diameter * diameter) {
    const bool has_specks = find_specks(shape.surface).count > 0;
    throw InvalidInput(about_model(
        name, has_specks
                  ? "it is too small beside how far away a small component of it lies: remove that"
                  : "its faces have no area, so no view shows anything of it"));
  }
}

}  // namespace vantage
