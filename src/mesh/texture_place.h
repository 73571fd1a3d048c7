// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/mesh/appearance.h"

namespace vantage {

/// Where texture coordinates of a material lie on its texture: its transform applied. Finite for any
/// finite transform: beyond 1e9 floats know no place on a texture, so it ends there.
inline std::array<double, 2> texture_place(const Material& material, double u, double v) {
  static constexpr double kFarthest = 1e9;
  const auto bounded = [](double place) {
    return std::isnan(place) ? 0.0 : std::clamp(place, -kFarthest, kFarthest);
  };
  const auto& m = material.uv_transform;
  return {bounded(m[0] * u + m[1] * v + m[2]), bounded(m[3] * u + m[4] * v + m[5])};
}

inline std::array<double, 2> texture_place(const Material& material,
                                           const std::array<float, 2>& uv) {
  return texture_place(material, static_cast<double>(uv[0]), static_cast<double>(uv[1]));
}

}  // namespace vantage
