// SPDX-License-Identifier: MIT
#include "value_checks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace vantage::cli {
namespace {

/// "0.3", "1000000": as people write numbers.
std::string plain(double number) {
  std::array<char, 64> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  return error == std::errc{} ? std::string(text.data(), end) : "?";
}

struct Unit {
  std::string_view name;
  double bytes;
};

constexpr std::array<Unit, 12> kUnits{{{"b", 1.0},
                                       {"kb", 1e3},
                                       {"mb", 1e6},
                                       {"gb", 1e9},
                                       {"tb", 1e12},
                                       {"k", 1e3},
                                       {"m", 1e6},
                                       {"g", 1e9},
                                       {"kib", 0x1p10},
                                       {"mib", 0x1p20},
                                       {"gib", 0x1p30},
                                       {"tib", 0x1p40}}};

/// What is wrong with a value of an option that takes a number; empty: nothing.
std::string problem_of_number(const std::string& text) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(text, value)) {
    return "must be a number, not " + text;
  }
  return std::isfinite(value) ? "" : "must be a finite number, not " + text;
}

/// The same of a whole number from 0.
std::string problem_of_count(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    return "is too large: " + text;
  }
  return CLI::detail::lexical_cast(text, value) ? "" : "must be a whole number from 0, not " + text;
}

/// The same of text: it is empty where a script has not set its variable.
std::string problem_of_text(const std::string& text) {
  return text.empty() ? "must not be empty" : "";
}

}  // namespace

std::string out_of_range(const std::string& text, double low, double high, bool is_whole) {
  return std::string("must be a ") + (is_whole ? "whole " : "") + "number from " + plain(low) +
         " to " + plain(high) + ", not " + text;
}

CLI::Validator whole_from_zero() {
  return {[](std::string& text) {
            return text.starts_with('-') ? "must be a whole number from 0, not " + text
                                         : std::string();
          },
          ""};
}

CLI::Validator size_in(double unit) {
  return {[unit](std::string& text) {
            double number = 0.0;
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), number);
            const auto length = static_cast<std::size_t>(end - text.data());
            std::string name = CLI::detail::trim_copy(text.substr(length));
            if (error != std::errc{} || name.empty()) {
              return std::string();  // a plain number, or none at all
            }
            name = CLI::detail::to_lower(name);
            const auto* const found =
                std::find_if(kUnits.begin(), kUnits.end(),
                             [&](const Unit& candidate) { return candidate.name == name; });
            if (found == kUnits.end()) {
              return "must be a number, perhaps with a unit, as in 500MB or 0.5GB, not " + text;
            }
            const double size = number * found->bytes / unit;
            text = plain(unit > 1.0 ? size : std::floor(size));
            return std::string();
          },
          ""};
}

void check_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) {
      option->check(problem_of_number, "", "finite");
    } else if (type.starts_with("UINT")) {
      option->check(problem_of_count, "", "fits");
    } else if (type == "TEXT") {
      option->check(problem_of_text, "", "not empty");
    }
  }
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    check_values(*below);
  }
}

}  // namespace vantage::cli
