// SPDX-License-Identifier: MIT
#include "option_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace vantage::cli {
namespace {

struct ValueText {
  std::string name{};
  std::vector<std::string> choices{};
  std::string range{};
};

/// CLI11 says "TEXT:{a,b}" for a choice and "INT:INT in [1 - 9]" for a range.
ValueText value_text(const std::string& type) {
  const std::size_t colon = type.find(':');
  const std::string kind = type.substr(0, colon);
  ValueText text;
  text.name = kind == "INT" || kind == "UINT" ? "N" : (kind == "FLOAT" ? "X" : kind);
  if (colon == std::string::npos) {
    return text;
  }
  const std::string rule = type.substr(colon + 1);
  const std::size_t open = rule.find(" in [");
  if (rule.starts_with('{') && rule.ends_with('}')) {
    text.choices = CLI::detail::split(rule.substr(1, rule.size() - 2), ',');
    text.name = CLI::detail::join(text.choices, "|");
  } else if (open != std::string::npos) {
    text.range = rule.substr(open + 5, rule.size() - open - 6);
    const std::size_t dash = text.range.find(" - ");
    text.range.replace(dash, 3, " to ");
  }
  return text;
}

/// Breaks a line between words so that help fits a terminal of 100 columns.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 70;
  std::string lines;
  std::size_t column = 0;
  for (const std::string& word : CLI::detail::split(text, ' ')) {
    const bool breaks = column > 0 && column + 1 + word.size() > kWidth;
    lines += breaks ? "\n" : (column > 0 ? " " : "");
    column = breaks ? word.size() : column + (column > 0 ? 1 : 0) + word.size();
    lines += word;
  }
  return lines;
}

struct OfferedValues {
  std::vector<std::string> values{};
  bool joins = false;
};

std::map<const CLI::Option*, OfferedValues>& offered_values() {
  static std::map<const CLI::Option*, OfferedValues> values;
  return values;
}

/// Options of people's first hours with a command, on any command that has them.
constexpr std::array<std::string_view, 26> kNeededFirst{
    "--output",    "--method", "--up",     "--views",    "--size",       "--style",
    "--no-images", "--json",   "--help",   "--help-all", "--tour",       "--preview",
    "--direction", "--camera", "--view",   "--show",     "--background", "--directions",
    "--sphere",    "--eyes",   "--levels", "--write",    "--jobs",       "--manifest",
    "--retry",     "--engine"};
/// A command with no more options than this shows all of them.
constexpr std::size_t kFewOptions = 16;

bool is_needed_first(const CLI::Option& option) {
  return option.get_positional() ||
         std::any_of(option.get_lnames().begin(), option.get_lnames().end(),
                     [](const std::string& name) {
                       return std::find(kNeededFirst.begin(), kNeededFirst.end(), "--" + name) !=
                              kNeededFirst.end();
                     });
}

class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const OptionText text = describe(*option);
    std::string words = text.value.empty() || text.positional ? "" : " " + text.value;
    words += text.repeats ? " ..." : "";
    return words + (text.required && !text.positional ? " (required)" : "");
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(describe(*option).meaning);
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::size_t count = describe_options(*app).size();
    shows_all_ = mode == CLI::AppFormatMode::All || count <= kFewOptions;
    // Commands below this one have help of their own, which follows if all is asked for.
    std::string help = CLI::Formatter::make_help(app, std::move(name), CLI::AppFormatMode::Normal);
    if (mode == CLI::AppFormatMode::All) {
      for (const CLI::App* command : commands_below(*app)) {
        help += "\n\n\n" + make_help(command, command->get_name(), mode);
      }
    }
    std::string closed;  // groups of which nothing is shown leave their blank lines
    for (const char c : help) {
      closed += c == '\n' && closed.ends_with("\n\n") ? "" : std::string(1, c);
    }
    return closed;
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (!shows_all_) {
      std::erase_if(options, [](const CLI::Option* option) { return !is_needed_first(*option); });
    }
    return options.empty() ? ""
                           : CLI::Formatter::make_group(std::move(group), is_positional, options);
  }

  std::string make_footer(const CLI::App* app) const override {
    const std::string more =
        shows_all_ ? ""
                   : "More options: vantage " + call_of(*app) + " --help-all lists all " +
                         std::to_string(describe_options(*app).size()) + ".\n\n";
    return more + CLI::Formatter::make_footer(app);
  }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    const std::string called = call_of(*app);
    return CLI::Formatter::make_usage(app, called.empty() ? name : "vantage " + called);
  }

 private:
  mutable bool shows_all_ = true;  // while one help is made
};

}  // namespace

void offer_values(const CLI::Option* option, std::vector<std::string> values, bool joins) {
  offered_values()[option] = {std::move(values), joins};
}

OptionText describe(const CLI::Option& option) {
  OptionText text;
  text.positional = option.get_positional();
  for (const std::string& name : option.get_snames()) {
    text.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    text.names.push_back("--" + name);
  }
  if (text.positional) {
    text.names = {option.get_name()};
  }
  text.required = option.get_required();
  text.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  text.meaning = option.get_description();
  text.group = option.get_group();
  if (const auto offered = offered_values().find(&option); offered != offered_values().end()) {
    text.choices = offered->second.values;
    text.joins = offered->second.joins;
  }
  if (option.get_type_size() == 0 || option.get_expected_max() == 0) {
    return text;  // a flag
  }
  ValueText value = value_text(option.get_type_name());
  text.value = std::move(value.name);
  if (!value.choices.empty()) {
    text.choices = std::move(value.choices);
  }
  std::string limits = value.range;
  if (!option.get_default_str().empty()) {
    limits += (limits.empty() ? "default: " : "; default: ") + option.get_default_str();
  }
  text.meaning += limits.empty() ? "" : " (" + limits + ")";
  return text;
}

std::vector<OptionText> describe_options(const CLI::App& command) {
  std::vector<OptionText> texts;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) {
      texts.push_back(describe(*option));
    }
  }
  // An option group is a command without a name.
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* below) { return below->get_name().empty(); })) {
    for (OptionText& text : describe_options(*group)) {
      if (!text.names.back().starts_with("--help")) {  // each group has these once more
        text.group = group->get_group();
        texts.push_back(std::move(text));
      }
    }
  }
  // Positionals first, then group by group in the order in which the groups came up.
  std::vector<std::string> groups;
  for (const OptionText& text : texts) {
    if (std::find(groups.begin(), groups.end(), text.group) == groups.end()) {
      groups.push_back(text.group);
    }
  }
  const auto place = [&](const OptionText& text) {
    return text.positional ? -1
                           : std::find(groups.begin(), groups.end(), text.group) - groups.begin();
  };
  std::stable_sort(texts.begin(), texts.end(),
                   [&](const OptionText& a, const OptionText& b) { return place(a) < place(b); });
  return texts;
}

std::vector<const CLI::App*> commands_below(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) {
    const bool option_group = command->get_name().empty();
    return !option_group && !command->get_group().empty();
  });
}

std::string call_of(const CLI::App& command) {
  if (command.get_parent() == nullptr) {
    return "";
  }
  const std::string above = call_of(*command.get_parent());
  return above.empty() ? command.get_name() : above + " " + command.get_name();
}

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

}  // namespace vantage::cli
