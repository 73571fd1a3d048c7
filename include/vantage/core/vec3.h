// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// \file
/// The vector type of every interface: 24 bytes of double, 8-aligned, so that a
/// std::vector<Vec3> can be viewed as a row-major n × 3 matrix without copying.

namespace vantage {

using Vec3 = Eigen::Vector3d;  ///< Point or direction, in model units unless stated otherwise.

}  // namespace vantage
