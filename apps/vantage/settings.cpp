// SPDX-License-Identifier: MIT
#include "settings.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

#include "batch/json_text.h"
#include "option_text.h"
#include "usage_hint.h"

namespace vantage::cli {
namespace {

using batch::Json;

constexpr const char* kConfig = "config";
constexpr std::size_t kLargest = 1U << 20U;  ///< Of a file of options, bytes.

/// A value and where it stands.
struct Setting {
  std::vector<std::string> values{};  // of a list; else one
  std::string origin{};
};

const CLI::App& program_of(const CLI::App& command) {
  return command.get_parent() == nullptr ? command : program_of(*command.get_parent());
}

bool any_command_has(const CLI::App& app, const std::string& option) {
  const auto below = commands_below(app);
  const CLI::Option* const own = app.get_option_no_throw("--" + option);
  return (own != nullptr && own->get_configurable()) ||
         std::any_of(below.begin(), below.end(),
                     [&](const CLI::App* command) { return any_command_has(*command, option); });
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  const auto below = commands_below(app);
  const auto found = std::find_if(below.begin(), below.end(), [&](const CLI::App* command) {
    return command->get_name() == name;
  });
  return found == below.end() ? nullptr : *found;
}

std::string unknown_option(const std::string& key, const std::string& call) {
  const std::string where = call.empty() ? "any command; see --help of the command it is meant for"
                                         : call + "; see vantage " + call + " --help";
  return "'" + key + "' is not an option of " + where;
}

/// Refuses keys that no command knows, so that a slip of the pen is not passed over.
void check_keys(const Json& settings, const CLI::App& app, const std::string& file) {
  for (const auto& [key, value] : settings.items()) {
    const CLI::App* command = command_named(app, key);
    if (value.is_object() && command != nullptr) {
      check_keys(value, *command, file);
    } else if (value.is_object()) {
      throw CLI::ValidationError(file, "'" + key + "' is not a command; see vantage --help");
    } else if (!any_command_has(app, key)) {
      throw CLI::ValidationError(file, unknown_option(key, call_of(app)));
    }
  }
}

/// JSON in which no object names a key twice.
Json parsed_once(const std::string& text, const std::string& file) {
  std::vector<std::set<std::string>> keys;  // of the objects around the place
  const auto look = [&](int /*depth*/, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) {
      keys.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      keys.pop_back();
    } else if (event == Json::parse_event_t::key &&
               !keys.back().insert(value.get<std::string>()).second) {
      throw CLI::ValidationError(file, "names '" + value.get<std::string>() + "' twice; keep one");
    }
    return true;
  };
  return Json::parse(text, look, true, true);
}

Json read_settings(const std::string& file, const CLI::App& program) {
  std::ifstream stream(file);
  std::string text(kLargest, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof()) {  // or a device that never ends
    throw CLI::ValidationError(file, "cannot be read; --config names a JSON file of options");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  Json settings;
  try {
    settings = parsed_once(text, file);
  } catch (const Json::parse_error& error) {
    throw CLI::ValidationError(file, "not JSON at byte " + std::to_string(error.byte) +
                                         "; write {\"threads\": 2, \"view\": {\"size\": 600}}");
  } catch (const Json::out_of_range&) {
    throw CLI::ValidationError(file, "has a number that is too large");
  }
  if (!settings.is_object()) {
    throw CLI::ValidationError(file, "holds no JSON object; write {\"threads\": 2}");
  }
  check_keys(settings, program, file);
  return settings;
}

std::string value_of(const Json& value, const std::string& origin) {
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (value.is_array()) {
    throw CLI::ValidationError(origin, "is a list of lists; give a list of values");
  }
  if (value.is_number() || value.is_boolean()) {
    return batch::json_text(value);
  }
  throw CLI::ValidationError(origin, "has no value; give a string, a number, true or false");
}

std::vector<std::string> values_of(const Json& setting, const std::string& origin) {
  if (!setting.is_array()) {
    return {value_of(setting, origin)};
  }
  std::vector<std::string> values;
  for (const Json& value : setting) {
    values.push_back(value_of(value, origin));
  }
  return values;
}

/// As one text, as an option with parts takes it.
std::string joined(const std::vector<std::string>& values) {
  return CLI::detail::join(values, ",");
}

std::optional<Setting> from_file(const Json& settings, const CLI::App& command,
                                 const std::string& option, const std::string& file) {
  const std::string origin = file + ": " + option;
  std::optional<Setting> found;
  const Json* table = &settings;  // from what is for all to what is for the command alone
  const auto look = [&] {
    if (table->is_object() && table->contains(option)) {
      found = Setting{values_of(table->at(option), origin), origin};
    }
  };
  look();
  for (const std::string& word : CLI::detail::split(call_of(command), ' ')) {
    if (!table->contains(word)) {
      break;
    }
    table = &table->at(word);
    look();
  }
  return found;
}

/// What an option is called in the environment; of a command alone if its words come first.
std::string variable_of(const std::string& words) {
  std::string name = "VANTAGE_" + words;
  for (char& c : name) {
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return name;
}

/// Adds the variables of a command's options, and of those below it, to a list.
void list_variables(CLI::App& app, const std::string& before, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options({})) {
    for (const std::string& name : option->get_lnames()) {
      if (option->get_configurable() || name == kConfig) {
        names.push_back(variable_of(before + name));
      }
    }
  }
  for (CLI::App* below : app.get_subcommands({})) {
    list_variables(*below, before, names);
  }
}

/// What to say of variables that begin as those of the command do, and are none.
std::vector<std::string> unknown_variables(CLI::App& command) {
  const std::string before = variable_of(call_of(command)) + "_";
  std::vector<std::string> own;
  list_variables(command, call_of(command) + " ", own);
  CLI::App* program = &command;
  while (program->get_parent() != nullptr) {
    program = program->get_parent();
  }
  std::vector<std::string> common;  // VANTAGE_VIEW_SET is of --view-set, not of `view`
  list_variables(*program, "", common);
  std::vector<std::string> warnings;
  for (char* const* entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    const auto is_in = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (name.starts_with(before) && !is_in(own) && !is_in(common)) {
      const std::string nearest = nearest_word(name, own);
      warnings.push_back(name + " is the name of no option of vantage " + call_of(command) +
                         (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  }
  return warnings;
}

std::optional<Setting> from_environment(const CLI::App& command, const std::string& option) {
  for (const std::string& words : {call_of(command) + " " + option, option}) {
    const std::string name = variable_of(words);
    const char* value = std::getenv(name.c_str());
    if (value != nullptr && *value != '\0') {
      return Setting{{value}, name};
    }
  }
  return std::nullopt;
}

/// The command line goes first, also where it names an option that excludes this one.
bool is_open(const CLI::Option& option) {
  const auto& excluded = option.get_excludes();
  return option.count() == 0 && option.get_configurable() && !option.get_lnames().empty() &&
         std::none_of(excluded.begin(), excluded.end(),
                      [](const CLI::Option* other) { return other->count() > 0; });
}

/// What a flag is set to; nothing where it is said to be off. \throw CLI::ValidationError
std::optional<std::string> flag_value(const CLI::Option& option, const std::string& word) {
  const std::string usual = option.get_flag_value(option.get_lnames().front(), "");
  if (word == "false" || word == "0") {
    return std::nullopt;
  }
  if (word == "true" || word == "1") {
    return usual;
  }
  if (usual == "true") {
    throw CLI::ValidationError("is a flag; say true or false");
  }
  return word;  // of a flag that may be given one, as --preview=blocks
}

void set(CLI::Option& option, const Setting& setting) {
  try {
    if (option.get_expected_max() == 0) {
      const std::optional<std::string> value = flag_value(option, joined(setting.values));
      if (!value) {
        return;
      }
      option.add_result(*value);
    } else if (option.get_expected_max() > 1) {
      option.add_result(setting.values);
    } else {
      option.add_result(joined(setting.values));
    }
    option.run_callback();
    option.envname(setting.origin);  // by which is_typed() knows
  } catch (const CLI::ParseError& error) {
    throw CLI::ValidationError(setting.origin, error.what());
  }
}

}  // namespace

void add_config_flag(CLI::App& command) {
  command
      .add_option(std::string("--") + kConfig,
                  "JSON file of options, for those not given here; none: no such file, and no "
                  "VANTAGE_* variables")
      ->type_name("FILE")
      ->configurable(false)
      ->group("Common");
}

std::vector<std::string> apply_settings(CLI::App& command) {
  const CLI::Option* config = command.get_option_no_throw(std::string("--") + kConfig);
  if (config == nullptr) {
    return {};  // a worker: its parent passes on what is set
  }
  const char* named = std::getenv("VANTAGE_CONFIG");
  const std::string file =
      config->count() > 0 ? config->as<std::string>() : (named == nullptr ? "" : named);
  if (file == "none") {
    return {};
  }
  const Json settings = file.empty() ? Json::object() : read_settings(file, program_of(command));
  for (CLI::Option* option : command.get_options({})) {
    if (!is_open(*option)) {
      continue;
    }
    const std::string& name = option->get_lnames().front();
    std::optional<Setting> setting = from_environment(command, name);
    if (!setting) {
      setting = from_file(settings, command, name, file);
    }
    if (setting) {
      set(*option, *setting);
    }
  }
  return unknown_variables(command);
}

bool is_typed(const CLI::Option& option) {
  return option.count() > 0 && option.get_envname().empty();
}

}  // namespace vantage::cli
