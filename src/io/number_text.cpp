// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>

#include "vantage/io/write.h"

namespace vantage {

std::string number_text(double value) {
  if (!std::isfinite(value)) {
    return "null";
  }
  std::array<char, 32> text{};  // the longest double has 24 characters
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

}  // namespace vantage
