// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// A polygon that goes around the places of an earlier one, from whatever corner and either way.
struct CopiedPolygon {
  std::size_t polygon = 0;
  std::uint32_t start = 0;  ///< Its corner where the earlier one begins.
  bool is_reversed = false;
};

/// The copies among polygons of four and more corners (triangles need not be told), ascending. Cut from
/// `start` on and the way of the earlier one, they fall into its triangles.
/// \param corners of all polygons, one after the other.
/// \param counts  of corners, of each polygon.
std::vector<CopiedPolygon> copied_polygons(std::span<const std::uint32_t> corners,
                                           std::span<const std::uint32_t> counts,
                                           std::span<const Vec3> positions);

}  // namespace vantage
