// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

namespace vantage {

/// A share in words, as "42 %".
inline std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

}  // namespace vantage
