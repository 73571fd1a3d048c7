// SPDX-License-Identifier: MIT
#pragma once

#include "orientation/height_fields.h"

namespace vantage {

/// What one side of the box shows of the surface. All of it is free of scale.
struct SideRelief {
  double touch = 0.0;       ///< Share of the outline that touches the side of the box.
  double touch_hull = 0.0;  ///< Area of the convex hull of what touches, over the outline's.
  double margin = 0.0;      ///< How far the centroid is inside that hull, over the outline's size.
  double contacts = 0.0;    ///< log2 of 1 + the number of separate patches that touch.
  double depth = 0.0;       ///< Mean depth behind the side of the box, over the longest side.
  double relative_depth = 0.0;  ///< The same over the box's depth.
  double centre_depth = 0.0;  ///< Mean in the inner third of the outline's box, over the depth …
  double rim_depth = 0.0;     ///< … and in its border of a sixth all around.
  double detail = 0.0;        ///< Mean step of depth from cell to cell, over the longest side.
  double back = 0.0;          ///< Share of the outline that shows the back of a face.
  double rest = 0.0;   ///< Share of all directions from the centroid that meet what touches' hull.
  double patch = 0.0;  ///< Share of what touches that is in the largest patch.
  double water = 0.0;  ///< Depth of rain that stays on it, mean over the outline, over the depth.
  double flat = 0.0;   ///< Share of steps of next to no depth.
};

/// \param axis 0, 1 or 2. \param from_high from the side of larger coordinates.
SideRelief side_relief(const HeightFields& fields, std::size_t axis, bool from_high);

/// Mean difference of a surface from its image in the box's middle plane across `axis`, in the
/// height fields along the other two and in its own; over the longest side; 0 if it mirrors itself.
double mirror_error(const HeightFields& fields, std::size_t axis);

/// Mean difference of the fields from those turned by 180 degrees about `axis`.
double half_turn_error(const HeightFields& fields, std::size_t axis);

/// The same by 90 degrees; 1 where the sides differ.
double quarter_turn_error(const HeightFields& fields, std::size_t axis);

}  // namespace vantage
