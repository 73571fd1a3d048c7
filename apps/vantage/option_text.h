// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// \file
/// What the program knows of its own options, in words: the one source of `--help`, the manual
/// pages, the completions and the names of settings.

namespace vantage::cli {

/// An option, a flag or a positional argument.
struct OptionText {
  std::vector<std::string> names{};    ///< "-s", "--size"; a positional's one name.
  bool positional = false;             ///< MODEL and the like.
  bool required = false;               ///< The command does not run without it.
  bool repeats = false;                ///< May be given, or take values, several times.
  std::string value{};                 ///< "N", "TEXT", "raw|finished"; empty for a flag.
  std::vector<std::string> choices{};  ///< Where only these values are allowed.
  bool joins = false;                  ///< Several of them may be joined by commas.
  std::string meaning{};               ///< One line, with range and default.
  std::string group{};                 ///< Heading that it stands under.
};

/// Says what values of an option may be completed to; its help does not list them. \param joins whether
/// it takes several of them, joined by commas.
void offer_values(const CLI::Option* option, std::vector<std::string> values, bool joins = false);

/// Describes one option.
OptionText describe(const CLI::Option& option);

/// Those of a command that are for people, positionals first, then as they were added.
std::vector<OptionText> describe_options(const CLI::App& command);

/// Commands below `app` that are for people.
std::vector<const CLI::App*> commands_below(const CLI::App& app);

/// "results query": the words that call a command, without the program's name.
std::string call_of(const CLI::App& command);

/// Prints help from OptionText: of commands with many options those that people need first, and with
/// --help-all every one.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace vantage::cli
