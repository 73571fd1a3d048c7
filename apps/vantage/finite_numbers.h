// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace vantage::cli {

/// Makes every option of every command that takes a real number refuse NaN and infinity: a range
/// alone lets NaN pass.
void require_finite_numbers(CLI::App& app);

}  // namespace vantage::cli
