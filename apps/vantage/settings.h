// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// \file
/// Options from the environment and from a file, for those that the command line leaves open.

namespace vantage::cli {

/// Adds --config FILE to a command.
void add_config_flag(CLI::App& command);

/// Sets every option of a command that the command line left open and that the environment
/// (VANTAGE_VIEW_SIZE, else VANTAGE_SIZE, for `--size` of `view`) or else the file of --config or
/// VANTAGE_CONFIG has a value for. The file holds a JSON object, comments allowed: keys are the
/// options' long names, and an object named like a command holds what is for that command alone.
/// \return a sentence each about variables that are named as the command's, and are none of them.
/// \throw CLI::ValidationError names the variable or the file and what is wrong with it.
std::vector<std::string> apply_settings(CLI::App& command);

/// Whether an option was typed. Of those that apply_settings() set, what has no effect is passed over, where
/// it would be refused if it was typed: settings are for many runs.
bool is_typed(const CLI::Option& option);

}  // namespace vantage::cli
