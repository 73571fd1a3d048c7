// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include "vantage/core/error.h"
#include "vantage/core/vec3.h"

namespace vantage {

/// A direction that a caller gave, as a unit vector: only where it points counts. One that is a unit vector up
/// to rounding comes back as it is, so that the library's own directions keep their bits.
/// \throw InvalidInput if it points nowhere.
inline Vec3 unit_direction(const Vec3& given) {
  constexpr double kRounding = 1e-12;  // of the squared length: far below what moves an eye visibly
  if (std::abs(given.squaredNorm() - 1.0) <= kRounding) {
    return given;
  }
  const std::optional<Vec3> unit = unit_vector(given);
  if (!unit) {
    throw InvalidInput("a direction must not be zero, and of a finite length");
  }
  return *unit;
}

}  // namespace vantage
