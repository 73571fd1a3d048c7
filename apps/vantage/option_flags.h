// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

/// \file
/// Flags made from the table of options.

namespace vantage::cli {

/// Flags for options, and what was given for them.
class OptionFlags {
 public:
  /// Adds a flag for each listed option of the groups. \param start what the help calls the default.
  void add_groups(CLI::App& app, std::initializer_list<std::string_view> groups,
                  const AllOptions& start = {});
  /// Adds the flag of one option.
  void add(CLI::App& app, const Option& option, const AllOptions& start = {});

  /// Whether the option was given.
  [[nodiscard]] bool has(const std::string& name) const { return given_.contains(name); }

  /// The same, on the command line.
  [[nodiscard]] bool is_typed(const std::string& name) const;

  /// The flag of the first option of a group that was typed; empty if none was.
  [[nodiscard]] std::string first_typed(std::string_view group) const;

  /// Of an option that has no effect, or contradicts another: whether it was typed. If it was set by a
  /// variable or a file, it is forgotten.
  bool insists_on(const std::string& name);
  /// Forgets what was not typed of a group.
  void forget(std::string_view group);

  /// Sets what was given, in the order of the table. \throw CLI::ValidationError; IoError, FormatError
  /// of files that are named
  void apply(AllOptions& all) const;

 private:
  CLI::Option* add_flag(CLI::App& app, const Option& option);
  template <class Value>
  CLI::Option* add_value(CLI::App& app, const Option& option);

  std::map<std::string, OptionValue> given_{};     // by the option's name
  std::map<std::string, CLI::Option*> options_{};  // by the option's name
};

/// What an option was refused for, as a complaint about its flag, or about `flag`.
CLI::ValidationError refused(const InvalidInput& error, std::string flag = {});

}  // namespace vantage::cli
