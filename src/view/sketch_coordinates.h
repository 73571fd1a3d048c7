// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/measures.h"

/// \file
/// Lists of points for loops that work on several numbers at a time. Coordinates are those of the
/// unit sphere that the scoring camera's sphere becomes.

namespace vantage {

/// Numbers worked on at a time where registers are wide.
inline constexpr unsigned kWideLanes = 8;

/// So many, or some more: whole registers.
inline std::size_t whole_registers(std::size_t count) {
  return (count + kWideLanes - 1) / kWideLanes * kWideLanes;
}

/// Coordinates of points, one array an axis.
struct SketchCoordinates {
  std::vector<float> x{}, y{}, z{};

  void append(const Vec3& p) {
    x.push_back(static_cast<float>(p.x()));
    y.push_back(static_cast<float>(p.y()));
    z.push_back(static_cast<float>(p.z()));
  }

  /// Adds zeros up to whole registers.
  void pad() {
    for (std::vector<float>* axis : {&x, &y, &z}) {
      axis->resize(whole_registers(axis->size()), 0.0F);
    }
  }
};

/// Planes, or cones of normals: an eye is before one if axis · eye > offset.
struct SketchPlanes {
  static constexpr float kAlways =
      std::numeric_limits<float>::lowest();                           ///< Every eye is before it,
  static constexpr float kNever = std::numeric_limits<float>::max();  ///< or none is.

  SketchCoordinates axis{};
  std::vector<float> offset{};

  void append(const Vec3& normal, float height) {
    axis.append(normal);
    offset.push_back(height);
  }

  /// Adds some that no eye is before, up to whole registers.
  void pad() {
    axis.pad();
    offset.resize(whole_registers(offset.size()), kNever);
  }
};

/// Maps the camera's sphere to the unit sphere.
inline Vec3 in_frame(const Sphere& sphere, const Vec3& p) {
  return (p - sphere.centre) * (2.0 / sphere.diameter);
}

}  // namespace vantage
