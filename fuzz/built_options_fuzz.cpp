// SPDX-License-Identifier: MIT
// Options set one after the other, to what is in their range, at its ends, beyond it or of another kind:
// in range afterwards, unchanged where refused, and what they say of themselves sets them again.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

#include "choices.h"

namespace {

using vantage::AllOptions;
using vantage::Option;
using vantage::OptionKind;
using vantage::OptionValue;

OptionValue fuzzed_number(const Option& option, Choices& choices) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<double, 10> values{option.low,
                                      option.high,
                                      (option.low + option.high) / 2.0,
                                      1.0,
                                      0.0,
                                      -1.0,
                                      std::nextafter(option.low, -kInfinity),
                                      std::nextafter(option.high, kInfinity),
                                      kInfinity,
                                      std::numeric_limits<double>::quiet_NaN()};
  return choices.of(values);
}

OptionValue fuzzed_integer(const Option& option, Choices& choices) {
  const auto low = static_cast<std::uint64_t>(option.low);
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t high =  // as a double kMost is one more
      option.high < static_cast<double>(kMost) ? static_cast<std::uint64_t>(option.high) : kMost;
  const std::array<std::uint64_t, 6> values{low,     high,     low + choices.below(16),
                                            low - 1, high + 1, kMost};
  return choices.of(values);
}

OptionValue fuzzed_text(Choices& choices) {
  constexpr std::array<const char*, 16> kTexts{
      "",      "1,0,0",   "640x480", "0x0",     "64",
      "1e9x1", "#ff8000", "white",   "nan,0,0", "/no/file",
      "none",  "a=b",     "0.5",     "-1",      "\xFF\x1B\xE2\x80\xAE",
      "1,2"};
  return std::string(choices.of(kTexts));
}

OptionValue fuzzed_value(const Option& option, Choices& choices) {
  switch (choices.once_in(16) ? static_cast<OptionKind>(choices.below(5)) : option.kind) {
    case OptionKind::Number:
      return fuzzed_number(option, choices);
    case OptionKind::Integer:
      return fuzzed_integer(option, choices);
    case OptionKind::Switch:
      return choices.below(2) == 1;
    case OptionKind::Choice:
      return option.words.empty() || choices.once_in(16)
                 ? fuzzed_text(choices)
                 : OptionValue(option.words[choices.below(option.words.size())]);
    case OptionKind::Text:
      break;
  }
  return choices.once_in(16) ? OptionValue() : fuzzed_text(choices);
}

void expect_in_range(const Option& option, const AllOptions& all) {
  const OptionValue value = option.value(all);
  const auto* const whole = std::get_if<std::uint64_t>(&value);
  const auto* const number = std::get_if<double>(&value);
  const double held = whole != nullptr    ? static_cast<double>(*whole)
                      : number != nullptr ? *number
                                          : option.low;
  if (!(held >= option.low && held <= option.high)) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const std::vector<Option>& table = vantage::option_table();
  AllOptions all;
  for (std::size_t i = 0; i < 12 && !choices.is_over(); ++i) {
    const Option& option = table[choices.below(table.size())];
    const OptionValue value = fuzzed_value(option, choices);
    const AllOptions before = all;
    try {
      option.set(all, value);
    } catch (const vantage::Error&) {
      if (vantage::options_json(all) != vantage::options_json(before)) {
        std::abort();
      }
    }
  }
  AllOptions again;
  for (const Option& option : table) {
    expect_in_range(option, all);
    const OptionValue value = option.value(all);
    if (!std::holds_alternative<std::monostate>(value)) {
      option.set(again, value);
    } else if (option.kind == OptionKind::Text) {
      option.set(again, std::string());
    }
  }
  if (vantage::options_json(again) != vantage::options_json(all)) {
    std::abort();
  }
  try {
    static_cast<void>(vantage::checked_view_set(all.view));
  } catch (const vantage::InvalidInput&) {
    return 0;
  }
  return 0;
}
