// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace vantage {

/// Order of the bytes of a number in a file.
enum class ByteOrder { Little, Big };

/// The value of type T stored at the start of `bytes`, which must hold sizeof(T) bytes.
template <class T>
T decode(const char* bytes, ByteOrder order) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(T));
  if ((order == ByteOrder::Little) != (std::endian::native == std::endian::little)) {
    std::reverse(raw.begin(), raw.end());
  }
  return std::bit_cast<T>(raw);
}

/// Appends `value` to `bytes`, lowest byte first.
template <class T>
void append_little_endian(std::string& bytes, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes.append(raw.data(), raw.size());
}

}  // namespace vantage
