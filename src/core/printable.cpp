// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>

#include "vantage/core/error.h"

namespace vantage {
namespace {

/// A code point and how many bytes it takes; bytes that are no UTF-8 count as control characters.
struct Letter {
  char32_t code = 0;
  std::size_t bytes = 1;
};

Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) {
    return {lead, 1};
  }
  const std::size_t length = lead >= 0xF0 ? 4 : (lead >= 0xE0 ? 3 : 2);
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};  // no longer than need be
  if (lead < 0xC2 || lead > 0xF4 || length > text.size()) {
    return {};
  }
  char32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {};
    }
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kLeast.at(length) || code > 0x10FFFF || is_surrogate ? Letter{}
                                                                     : Letter{code, length};
}

bool is_within(char32_t code, char32_t first, char32_t last) {
  return code >= first && code <= last;
}

/// Not controls (C0, DEL, C1), nor what turns the direction of writing, nor ends of lines.
bool is_shown(char32_t code) {
  return code >= 0x20 && !is_within(code, 0x7F, 0x9F) && code != 0x061C &&
         !is_within(code, 0x200E, 0x200F) && !is_within(code, 0x2028, 0x202E) &&
         !is_within(code, 0x2066, 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    if (is_shown(letter.code)) {
      clean += text.substr(0, letter.bytes);
    } else {
      clean += '?';
    }
    text.remove_prefix(letter.bytes);
  }
  return clean;
}

}  // namespace vantage
