// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/vec3.h"

#include "core/degrees.h"

namespace vantage {

/// Angle between two vectors in radians, accurate also near 0 and π.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Six directions at the angle `step_rad` around `centre`.
inline std::vector<Vec3> ring_around(const Vec3& centre, double step_rad) {
  constexpr int kCount = 6;
  const Vec3 right = centre.unitOrthogonal();
  const Vec3 up = centre.cross(right);
  std::vector<Vec3> ring;
  ring.reserve(kCount);
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    const Vec3 aside = std::cos(angle) * right + std::sin(angle) * up;
    const Vec3 direction = std::cos(step_rad) * centre + std::sin(step_rad) * aside;
    ring.push_back(direction.normalized());
  }
  return ring;
}

}  // namespace vantage
