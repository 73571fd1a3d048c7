// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>

#include "vantage/core/error.h"
#include "vantage/view/search.h"

namespace vantage {

void set_epsilon(SearchOptions& options, std::string_view text) {
  const bool is_share = text.ends_with('%');
  const std::string_view number = text.substr(0, text.size() - (is_share ? 1 : 0));
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value)) {
    throw InvalidInput("option epsilon must be a number, or a number and %, not '" +
                       std::string(text) + "'");
  }
  if (value < 0.0) {
    throw InvalidInput("option epsilon must not be negative");
  }
  options.epsilon = is_share ? value / 100.0 : value;
  options.epsilon_is_fraction = is_share;
}

std::string epsilon_text(const SearchOptions& options) {
  const bool is_share = options.epsilon_is_fraction;
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(),
                                     is_share ? 100.0 * options.epsilon : options.epsilon);
  return std::string(text.data(), written.ptr) + (is_share ? "%" : "");
}

}  // namespace vantage
