// SPDX-License-Identifier: MIT
#include "value_checks.h"

#include <cmath>
#include <string>

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
