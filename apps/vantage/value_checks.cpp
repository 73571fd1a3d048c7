// SPDX-License-Identifier: MIT
#include "value_checks.h"

#include <cmath>

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
    if (option->check_lname("output")) {
      option->check(
          [](const std::string& text) {
            return text.empty() ? "must name a place, not nothing" : "";
          },
          "", "named");
    }
  }
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    check_values(*below);
  }
}

}  // namespace vantage::cli
