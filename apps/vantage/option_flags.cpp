// SPDX-License-Identifier: MIT
#include "option_flags.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "vantage/pipeline/option_table.h"

#include "settings.h"
#include "terminal.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

/// As the help says a default; empty where nothing is set.
std::string default_text(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return rounded(*number);
  }
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) {
    return std::to_string(*whole);
  }
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? "" : *text;
}

/// Whether a text can be judged without looking at anything else.
bool stands_alone(const Option& option) {
  return option.form != TextForm::File && option.form != TextForm::Name;
}

bool is_on_by_default(const Option& option) {
  return option.kind == OptionKind::Switch && std::get<bool>(option.value({}));
}

}  // namespace

CLI::ValidationError refused(const InvalidInput& error, std::string flag) {
  constexpr std::string_view kStart = "option ";
  const std::string what = error.what();
  const std::size_t end = what.find(' ', kStart.size());
  if (!what.starts_with(kStart) || end == std::string::npos) {
    return CLI::ValidationError(flag, what);
  }
  flag = flag.empty() ? "--" + what.substr(kStart.size(), end - kStart.size()) : flag;
  return CLI::ValidationError(flag + what.substr(end));
}

template <class Value>
CLI::Option* OptionFlags::add_value(CLI::App& app, const Option& option) {
  return app.add_option_function<Value>(
      "--" + option.name,
      [this, &option](const Value& value) {
        if constexpr (std::is_same_v<Value, std::int64_t>) {
          given_[option.name] = static_cast<std::uint64_t>(value);  // checked to be in range
        } else {
          given_[option.name] = value;
        }
        if (option.kind == OptionKind::Text && stands_alone(option)) {
          AllOptions any;
          try {
            option.set(any, given_[option.name]);
          } catch (const InvalidInput& error) {
            throw refused(error);
          }
        }
      },
      option.help);
}

CLI::Option* OptionFlags::add_flag(CLI::App& app, const Option& option) {
  const bool is_on = is_on_by_default(option);
  return app
      .add_flag_callback(
          flag_of(option), [this, &option, is_on] { given_[option.name] = !is_on; },
          is_on ? option.off_help : option.help)
      ->group(option.heading);
}

void OptionFlags::add(CLI::App& app, const Option& option, const AllOptions& start) {
  CLI::Option* flag = nullptr;
  switch (option.kind) {
    case OptionKind::Switch:
      options_[option.name] = add_flag(app, option);
      return;
    case OptionKind::Number:
      flag = add_value<double>(app, option)->check(within(option.low, option.high));
      break;
    case OptionKind::Integer:
      flag = add_value<std::int64_t>(app, option)
                 ->check(within(static_cast<std::int64_t>(option.low),
                                static_cast<std::int64_t>(option.high)));
      break;
    case OptionKind::Choice:
      flag = add_value<std::string>(app, option)
                 ->transform(CLI::IsMember(option.words, CLI::ignore_case));
      break;
    case OptionKind::Text:
      flag = add_value<std::string>(app, option);
      break;
  }
  options_[option.name] = flag->group(option.heading);
  const std::string value = default_text(option.value(start));
  if (!value.empty()) {
    flag->default_str(value);
  }
}

void OptionFlags::add_groups(CLI::App& app, std::initializer_list<std::string_view> groups,
                             const AllOptions& start) {
  for (const Option& option : option_table()) {
    const bool is_wanted = std::find(groups.begin(), groups.end(), option.group) != groups.end();
    if (is_wanted && option.is_listed() && option.name != "seed") {  // which every command has
      add(app, option, start);
    }
  }
}

bool OptionFlags::is_typed(const std::string& name) const {
  return has(name) && cli::is_typed(*options_.at(name));
}

std::string OptionFlags::first_typed(std::string_view group) const {
  for (const Option& option : option_table()) {
    if (option.group == group && is_typed(option.name)) {
      return flag_of(option);
    }
  }
  return {};
}

bool OptionFlags::insists_on(const std::string& name) {
  if (is_typed(name)) {
    return true;
  }
  if (given_.erase(name) > 0) {
    options_.at(name)->clear();
  }
  return false;
}

void OptionFlags::forget(std::string_view group) {
  for (const Option& option : option_table()) {
    if (option.group == group) {
      insists_on(option.name);
    }
  }
}

void OptionFlags::apply(AllOptions& all) const {
  try {
    for (const Option& option : option_table()) {
      const auto given = given_.find(option.name);
      if (given != given_.end()) {
        option.set(all, given->second);
      }
    }
  } catch (const InvalidInput& error) {
    throw refused(error);
  }
}

}  // namespace vantage::cli
