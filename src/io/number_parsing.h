// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// \file
/// Numbers in text, the same in every locale.

namespace vantage {

/// The decimal number that fills `token`; infinite if it is too large for a double, zero if too
/// small, NaN for "nan". Nothing if the token is not a number (hexadecimal, "1,5", "1d3", …).
std::optional<double> number_from(std::string_view token);

/// The whole number that fills `token`; the largest or smallest value if it does not fit.
std::optional<std::int64_t> integer_from(std::string_view token);

/// Whether `token`, whose value is `value`, says more than a float can hold: the nearest float is
/// more than half a unit of the token's last digit away.
bool needs_double(std::string_view token, double value);

/// `token` in quotes for a message: printable(), and cut between letters after 40 bytes.
std::string in_quotes(std::string_view token);

/// What is wrong with a token that should have been a finite number.
std::string number_problem(std::string_view token);

}  // namespace vantage
