// SPDX-License-Identifier: MIT
#include "report/point_balls.h"

#include <array>

namespace vantage {

PointBalls point_balls(std::span<const Vec3> points, double radius) {
  // Wound outwards, corners ±x, ±y, ±z.
  constexpr std::array<Triangle, 8> kFaces{
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  PointBalls balls;
  const std::size_t step = (points.size() + kMostBalls - 1) / kMostBalls;
  for (std::size_t p = 0; p < points.size(); p += step) {
    const auto first = static_cast<std::uint32_t>(balls.mesh.positions.size());
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {radius, -radius}) {
        balls.mesh.positions.emplace_back(points[p] + side * Vec3::Unit(axis));
        balls.point_of_vertex.push_back(static_cast<std::uint32_t>(p));
      }
    }
    for (const Triangle& f : kFaces) {
      balls.mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
    }
  }
  return balls;
}

}  // namespace vantage
