// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "vantage/core/vec3.h"

namespace vantage {

/// One of the six directions along the box's axes.
struct AxisDirection {
  std::size_t axis = 2;
  bool is_positive = true;

  [[nodiscard]] AxisDirection opposite() const { return {axis, !is_positive}; }

  /// Its place among axis_directions().
  [[nodiscard]] std::size_t index() const { return 2 * axis + (is_positive ? 0 : 1); }

  [[nodiscard]] Vec3 vector() const {
    return Vec3::Unit(static_cast<Eigen::Index>(axis)) * (is_positive ? 1.0 : -1.0);
  }

  friend bool operator==(const AxisDirection&, const AxisDirection&) = default;
};

/// +x, −x, +y, −y, +z, −z.
constexpr std::array<AxisDirection, 6> axis_directions() {
  return {{{0, true}, {0, false}, {1, true}, {1, false}, {2, true}, {2, false}}};
}

/// A place along a direction's axis, measured the way that the direction points. \param share from the
/// box's low side, over that side.
inline double oriented(double share, AxisDirection direction) {
  return direction.is_positive ? share : 1.0 - share;
}

/// A vector's component along a direction.
inline double signed_part(const Vec3& vector, AxisDirection direction) {
  const double part = vector[static_cast<Eigen::Index>(direction.axis)];
  return direction.is_positive ? part : -part;
}

}  // namespace vantage
