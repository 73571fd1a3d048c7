// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

namespace vantage {

/// Convex hull, counter-clockwise (Andrew's monotone chain); of fewer than three points, nothing.
std::vector<Eigen::Vector2d> planar_hull(std::vector<Eigen::Vector2d> points);

}  // namespace vantage
