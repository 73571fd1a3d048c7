// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include <CLI/CLI.hpp>

namespace vantage::cli {

/// What is said of a value that is no number from `low` to `high`.
std::string out_of_range(const std::string& text, double low, double high, bool is_whole);

/// CLI::Range that says what was given and what is wanted.
template <class Number>
CLI::Validator within(Number low, Number high) {
  const CLI::Range range(low, high);
  CLI::Validator check = range;  // with its description, which help shows
  check.operation([range, low, high](std::string& text) {
    return range(text).empty()
               ? std::string()
               : out_of_range(text, static_cast<double>(low), static_cast<double>(high),
                              std::is_integral_v<Number>);
  });
  return check;
}

/// Refuses a sign before a whole number without an upper bound, which would make it a large one.
CLI::Validator whole_from_zero();

/// Turns a size such as 500MB, 0.5 GB or 2GiB into a number of `unit` bytes; a plain number is one
/// already.
CLI::Validator size_in(double unit);

/// Makes every option of a program and of its commands that takes numbers refuse infinity and NaN,
/// which no option has a meaning for, and those that take text refuse an empty one: a variable that a
/// script has not set. \pre all options have been added.
void check_values(CLI::App& app);

}  // namespace vantage::cli
