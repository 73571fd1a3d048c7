// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

namespace vantage {

/// Twice the area of a triangle, positive where it goes round counter-clockwise.
double twice_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Convex hull, counter-clockwise (Andrew's monotone chain); of fewer than three points, nothing.
std::vector<Eigen::Vector2d> planar_hull(std::vector<Eigen::Vector2d> points);

}  // namespace vantage
