// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/view/measure.h"

/// \file
/// The boundary of a shape in the plane that is given as a chain of directed segments.

namespace vantage {

/// A piece of the boundary of some layers of a shape, which lie on its left.
struct LayerEdge {
  PicturePoint from = PicturePoint::Zero();
  PicturePoint to = PicturePoint::Zero();
  int layers = 1;  ///< How many layers end here; negative: they lie on the right.
};

/// The boundary of the points that at least one layer covers, exactly but for rounding: whatever
/// crosses, touches or coincides, the result is closed loops with the shape on their left.
/// \param edges a closed chain: at each point as many layers begin as end.
Outline boundary_of_layers(const std::vector<LayerEdge>& edges);

}  // namespace vantage
