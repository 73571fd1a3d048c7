// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace vantage {

/// Twice the area of the triangle of 0, a and b: positive if b lies to the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace vantage
