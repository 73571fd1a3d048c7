// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage {

/// A field of CSV that may hold anything.
inline std::string csv_field(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) {
    field += c == '"' ? "\"\"" : std::string(1, c);
  }
  return field + "\"";
}

}  // namespace vantage
