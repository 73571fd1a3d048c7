// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// What a surface's faces, edges and parts say of one side of its box. Free of scale and of the
/// order of vertices and faces.
struct SideTraits {
  double facing = 0.0;  ///< Share of the area that faces the side squarely.
  double facing_place =
      0.5;                 ///< Mean place of that area from the far side, share of the box's side.
  double area_end = 0.0;   ///< Share of the area in the tenth of the box at the side.
  double open_end = 0.0;   ///< Length of open edges in that tenth, over the box's longest side.
  double parts_end = 0.0;  ///< Share of the connected parts that reach the side.
  double poles = 0.0;      ///< Share of many-edged vertices (caps of turned parts) that face it.
};

/// The same of one axis of the box.
struct AxisTraits {
  double edges_along = 0.0;  ///< Share of the length of bent edges that is along the axis.
  double parts_mean = 0.5;   ///< Mean place of the connected parts' boxes from the low side.
  double area_spread = 0.0;  ///< Standard deviation of the area's place, share of the side.
};

struct SurfaceTraits {
  explicit SurfaceTraits(const TriMesh& surface);

  std::array<SideTraits, 6> side{};  ///< +x, −x, +y, −y, +z, −z.
  std::array<AxisTraits, 3> axis{};
  double open = 0.0;   ///< Length of open edges over the box's longest side, log2 of 1 + that.
  double parts = 0.0;  ///< log2 of the number of connected parts.
};

}  // namespace vantage
