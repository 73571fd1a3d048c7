// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace vantage {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

}  // namespace vantage
