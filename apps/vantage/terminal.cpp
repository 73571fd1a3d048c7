// SPDX-License-Identifier: MIT
#include "terminal.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace vantage::cli {
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

std::string printable_lines(std::string_view text) {
  std::string clean;
  for (;;) {
    const std::size_t end = text.find('\n');
    clean += printable(text.substr(0, end));
    if (end == std::string_view::npos) {
      return clean;
    }
    clean += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) {
    digits.insert(at - 3, " ");
  }
  return digits;
}

std::string rounded(double value, int digits) {
  std::array<char, 64> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::general, digits);
  return error == std::errc{} ? std::string(buffer.data(), end) : std::string("?");
}

std::string plural(std::size_t count, std::string_view noun) {
  std::string text = grouped(count) + " " + std::string(noun);
  if (count == 1) {
    return text;
  }
  if (noun == "vertex") {
    return grouped(count) + " vertices";
  }
  if (noun.ends_with("ary")) {
    return text.substr(0, text.size() - 1) + "ies";
  }
  return text + "s";
}

std::string aligned(const std::vector<std::vector<std::string>>& rows, Alignment alignment) {
  const auto letters = [](const std::string& text) {  // of UTF-8
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
  };
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], letters(row[c]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - letters(row[c]), ' ');
      const bool is_left = c == 0 || alignment == Alignment::Left;
      line += (c == 0 ? "" : "  ") + (is_left ? row[c] + blanks : blanks + row[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

}  // namespace vantage::cli
