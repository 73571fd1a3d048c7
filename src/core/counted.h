// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vantage {

/// "1 vertex", "2 vertices", and what follows.
inline std::string counted(std::size_t count, std::string_view one, std::string_view many,
                           std::string_view rest = "") {
  std::string text = std::to_string(count);
  text += ' ';
  text += count == 1 ? one : many;
  text += rest;
  return text;
}

}  // namespace vantage
