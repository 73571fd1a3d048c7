// SPDX-License-Identifier: MIT
#include "io/number_parsing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "vantage/core/error.h"

namespace vantage {
namespace {

/// Digits and exponent of a decimal number, without its value.
struct DecimalShape {
  long first_digit_exponent = 0;  ///< Power of ten of the first digit that is not 0.
  long last_digit_exponent = 0;   ///< Power of ten of the last digit written.
  int significant_digits = 0;     ///< From the first digit that is not 0 to the last written.
};

DecimalShape decimal_shape(std::string_view token) {
  DecimalShape shape;
  long fraction_digits = 0;
  bool after_point = false;
  std::size_t i = 0;
  for (; i < token.size() && token[i] != 'e' && token[i] != 'E'; ++i) {
    if (token[i] == '.') {
      after_point = true;
    } else if (token[i] >= '0' && token[i] <= '9') {
      fraction_digits += after_point ? 1 : 0;
      shape.significant_digits += shape.significant_digits > 0 || token[i] != '0' ? 1 : 0;
    }
  }
  long exponent = 0;
  if (i < token.size()) {
    const std::optional<std::int64_t> written = integer_from(token.substr(i + 1));
    constexpr std::int64_t kFarBeyondDouble = 1'000'000'000;
    exponent =
        static_cast<long>(std::clamp(written.value_or(0), -kFarBeyondDouble, kFarBeyondDouble));
  }
  shape.last_digit_exponent = exponent - fraction_digits;
  shape.first_digit_exponent = shape.last_digit_exponent + shape.significant_digits - 1;
  return shape;
}

std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+') {
    token.remove_prefix(1);
  }
  return token;
}

}  // namespace

std::optional<double> number_from(std::string_view token) {
  token = without_plus(token);
  double value = 0.0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    const bool negative = token.front() == '-';
    const bool too_large = decimal_shape(token).first_digit_exponent > 0;
    value = too_large ? std::numeric_limits<double>::infinity() : 0.0;
    return negative ? -value : value;
  }
  return value;
}

std::optional<std::int64_t> integer_from(std::string_view token) {
  token = without_plus(token);
  std::int64_t value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    return token.front() == '-' ? std::numeric_limits<std::int64_t>::min()
                                : std::numeric_limits<std::int64_t>::max();
  }
  return value;
}

bool needs_double(std::string_view token, double value) {
  constexpr std::size_t kDigitsEveryFloatHolds = 6;  // std::numeric_limits<float>::digits10
  if (token.size() <= kDigitsEveryFloatHolds || value == 0.0) {
    return false;
  }
  const double magnitude = std::abs(value);
  if (magnitude > static_cast<double>(std::numeric_limits<float>::max()) ||
      magnitude < static_cast<double>(std::numeric_limits<float>::min())) {
    return true;
  }
  const double error = std::abs(value - static_cast<double>(static_cast<float>(value)));
  if (error == 0.0) {
    return false;
  }
  // A hair of slack: 9 digits of a float may stand exactly half a unit away.
  constexpr double kHalfUnit = 0.5000001;
  const double unit = std::pow(10.0, static_cast<double>(decimal_shape(token).last_digit_exponent));
  return error > kHalfUnit * unit;
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t kLongest = 40;  // bytes
  constexpr std::size_t kLetter = 4;    // of UTF-8, at most
  const auto goes_on = [&](std::size_t at) {
    return (static_cast<unsigned char>(token[at]) & 0xC0U) == 0x80U;
  };
  std::size_t end = std::min(token.size(), kLongest);
  while (end < token.size() && end + kLetter > kLongest && goes_on(end)) {
    --end;
  }
  return "'" + printable(token.substr(0, end)) + (end < token.size() ? "…'" : "'");
}

std::string number_problem(std::string_view token) {
  const std::optional<double> value = number_from(token);
  if (value && std::isnan(*value)) {
    return in_quotes(token) + " is not a finite number";
  }
  if (value && std::isinf(*value)) {
    return in_quotes(token) + " is infinite or too large";
  }
  std::string text = "expected a number, found " + in_quotes(token);
  if (token.find(',') != std::string_view::npos) {
    text += "; write decimals with a point and separate numbers by spaces";
  }
  return text;
}

}  // namespace vantage
