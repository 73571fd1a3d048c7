// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace vantage::cli {

/// Makes every option of a program and of its commands that takes numbers refuse infinity and NaN,
/// which no option has a meaning for, and those that take text refuse an empty one: a variable that a
/// script has not set. \pre all options have been added.
void check_values(CLI::App& app);

}  // namespace vantage::cli
