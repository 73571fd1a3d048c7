// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vantage::cli {

/// printable() of each line of a text.
std::string printable_lines(std::string_view text);

/// 1234567 → "1 234 567".
std::string grouped(std::size_t number);

/// A number with `digits` significant digits, for people.
std::string rounded(double value, int digits = 4);

/// `count` with its noun: "1 cycle", "2 cycles".
std::string plural(std::size_t count, std::string_view noun);

/// Where cells of a table stand in their columns.
enum class Alignment {
  Left,
  FirstLeft,  ///< The first column; the others, of numbers, to the right.
};

/// Rows as lines, two blanks between columns, no line end after the last. \pre rows of one length
std::string aligned(const std::vector<std::vector<std::string>>& rows, Alignment alignment);

}  // namespace vantage::cli
