// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

/// \file
/// The vector type of every interface: 24 bytes of double, 8-aligned, so that a
/// std::vector<Vec3> can be viewed as a row-major n × 3 matrix without copying.

namespace vantage {

using Vec3 = Eigen::Vector3d;  ///< Point or direction, in model units unless stated otherwise.

/// `vector` made a unit vector; nothing if its length is 0, or too large for a number.
inline std::optional<Vec3> unit_vector(const Vec3& vector) {
  const double length = vector.stableNorm();
  return length > 0.0 && std::isfinite(length) ? std::optional<Vec3>(vector / length)
                                               : std::nullopt;
}

}  // namespace vantage
