// SPDX-License-Identifier: MIT
#include "terminal.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "vantage/core/error.h"

namespace vantage::cli {
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
