// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Triangulates a simple polygon in space, convex or not, by ear clipping in its best-fit plane
/// (Newell's normal). Always yields n − 2 triangles for n ≥ 3 corners (also for degenerate or
/// self-crossing input, where no triangulation is right), none for fewer. Winding is kept.
///
/// \param corners   indices into `positions`, in order around the polygon.
/// \param positions all points.
/// \param triangles receives the triangles at its end.
void triangulate_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                         std::vector<Triangle>& triangles);

}  // namespace vantage
