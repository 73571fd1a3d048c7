// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace vantage {

/// A number of a table with so many decimals; a dash if it is none.
inline std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "–";
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

}  // namespace vantage
