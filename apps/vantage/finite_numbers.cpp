// SPDX-License-Identifier: MIT
#include "finite_numbers.h"

#include <cmath>

namespace vantage::cli {

void require_finite_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options(
           [](const CLI::Option* any) { return any->get_type_name().starts_with("FLOAT"); })) {
    option->check(
        [](const std::string& text) {
          double value = 0.0;
          const bool is_number = CLI::detail::lexical_cast(text, value);
          return is_number && !std::isfinite(value) ? "must be a finite number, not " + text : "";
        },
        "", "finite");
  }
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    require_finite_numbers(*below);
  }
}

}  // namespace vantage::cli
