// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace vantage {

/// Where in a file something stands: a line of text (from 1) or a byte (from 0).
struct Place {
  const char* unit = "line";
  std::size_t value = 0;

  [[nodiscard]] std::string text() const { return unit + (" " + std::to_string(value)); }
};

}  // namespace vantage
