// SPDX-License-Identifier: MIT
#include "value_checks.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

namespace vantage::cli {

void check_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) {
      option->check(
          [](const std::string& text) {
            double value = 0.0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            return is_number && !std::isfinite(value) ? "must be a finite number, not " + text : "";
          },
          "", "finite");
    }
    if (option->get_type_name().starts_with("UINT")) {
      option->check(
          [](const std::string& text) {
            std::uint64_t value = 0;
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            return error == std::errc::result_out_of_range ? "is too large: " + text : "";
          },
          "", "fits");
    }
    if (option->get_type_name() == "TEXT") {  // as of a variable that a script has not set
      option->check([](const std::string& text) { return text.empty() ? "must not be empty" : ""; },
                    "", "not empty");
    }
  }
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    check_values(*below);
  }
}

}  // namespace vantage::cli
