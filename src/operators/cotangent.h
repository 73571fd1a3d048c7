// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <Eigen/Geometry>

#include "vantage/core/vec3.h"

namespace vantage {

/// Cotangent of the angle at `apex` in the triangle apex, p, q, clamped to ± limit; 0 if the
/// triangle has no area.
inline double cotangent(const Vec3& apex, const Vec3& p, const Vec3& q, double limit) {
  const Vec3 u = p - apex;
  const Vec3 v = q - apex;
  const double twice_area = u.cross(v).norm();
  if (!(twice_area > 0.0)) {
    return 0.0;
  }
  return std::clamp(u.dot(v) / twice_area, -limit, limit);
}

}  // namespace vantage
