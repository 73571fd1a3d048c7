// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Triangulated direction sets on the unit sphere.

namespace vantage {

/// The polyhedron a direction set starts from.
enum class ViewSphereBase {
  Cube,         ///< (±1,±1,±1)/√3, each square split along the diagonal that joins its
                ///< lexicographically smallest corner to the opposite one.
  Icosahedron,  ///< (0,±1,±φ) and its cyclic permutations, normalised.
};

/// Unit directions joined by triangles, counter-clockwise from outside.
struct DirectionSet {
  std::vector<Vec3> directions{};     ///< Unit vectors; coarser levels come first.
  std::vector<Triangle> triangles{};  ///< Every direction is a corner.
};

/// The base split `level` times: every triangle in four at edge midpoints, projected to the sphere.
/// Icosahedron levels 0–5 give 12, 42, 162, 642, 2 562 and 10 242 directions.
/// The corners of the base come in lexicographic order of their coordinates, later ones in the order
/// of the first triangle that needs them.
/// \pre 0 ≤ level ≤ 8. \throw InvalidInput
DirectionSet direction_set(ViewSphereBase base, int level);

/// New vertex of edge ab between triangles abc and bad: 3/8 a + 3/8 b + 1/8 c + 1/8 d, projected
/// to the unit sphere. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987.
/// \throw InvalidInput if one of them is zero or not finite
Vec3 loop_edge_direction(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace vantage
