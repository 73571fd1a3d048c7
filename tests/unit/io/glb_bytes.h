// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "io/byte_cursor.h"

namespace vantage::test {

/// A GLB from its JSON and its binary chunk.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append_little_endian(bytes, std::uint32_t{2});
  append_little_endian(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  append_little_endian(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_little_endian(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

}  // namespace vantage::test
