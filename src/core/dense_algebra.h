// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vantage/core/vec3.h"

namespace vantage {

// Decompositions of Eigen that take a compiler longer than most sources do: instantiated in one place.

/// The x of least |A x − b|, and of these the shortest. A is n × m, b has n entries.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The shortest rotation that takes the direction of `from` to that of `to`; of opposite ones, half a
/// turn about some perpendicular. Neither is 0.
Eigen::Quaterniond shortest_rotation(const Vec3& from, const Vec3& to);

}  // namespace vantage
