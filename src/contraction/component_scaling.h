// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/contraction/history.h"

namespace vantage {

/// The unit in which one component is contracted: x_scaled = (x − centre) · factor.
struct ComponentScaling {
  Vec3 centre = Vec3::Zero();
  double factor = 1.0;

  /// By the enclosing sphere or the axis-aligned box of the points; factor 1 where they are one point.
  ComponentScaling(const std::vector<Vec3>& points, ContractionScaling kind);

  [[nodiscard]] Vec3 scaled(const Vec3& point) const { return (point - centre) * factor; }

  [[nodiscard]] Vec3 unscaled(const Vec3& point) const { return point / factor + centre; }
};

}  // namespace vantage
