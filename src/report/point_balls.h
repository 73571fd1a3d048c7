// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Points made visible: a small solid at each.

namespace vantage {

/// At most this many points are shown; of more, one in every so many. [ours]
inline constexpr std::size_t kMostBalls = 20'000;

/// Radius of a point in pictures, over D.
inline constexpr double kPointRadius = 0.005;

/// Octahedra around points.
struct PointBalls {
  TriMesh mesh{};
  std::vector<std::uint32_t> point_of_vertex{};  ///< Whose octahedron each vertex is of.
};

/// \param radius model units, > 0.
PointBalls point_balls(std::span<const Vec3> points, double radius);

}  // namespace vantage
