// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include "vantage/core/version.h"
#include "vantage/io/write.h"

#include "commands.h"
#include "option_text.h"

/// \file
/// `vantage manual DIR`, called by the build: manual pages in man(7) from the very options that the
/// program parses, one page for the program and one for each command.

namespace vantage::cli {
namespace {

/// Text as roff prints it: no request at a line's start, hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string safe;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) {
      safe += "\\&";
    }
    safe += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
    line_start = c == '\n';
  }
  return safe;
}

std::string dashed(std::string call) {
  for (char& c : call) {
    c = c == ' ' ? '-' : c;
  }
  return call.empty() ? "vantage" : "vantage-" + call;
}

std::string upper(std::string text) {
  for (char& c : text) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return text;
}

std::string synopsis(const CLI::App& command) {
  std::string line = ".B vantage " + roff(call_of(command)) + "\n";
  if (!commands_below(command).empty()) {
    return line + ".I COMMAND\n[\\fIOPTIONS\\fR]\n";
  }
  line += "[\\fIOPTIONS\\fR]\n";
  for (const OptionText& option : describe_options(command)) {
    if (option.positional) {
      const std::string name =
          "\\fI" + roff(option.names[0]) + "\\fR" + (option.repeats ? "..." : "");
      line += (option.required ? name : "[" + name + "]") + "\n";
    }
  }
  return line;
}

std::string option_entries(const CLI::App& command) {
  std::string page;
  std::string group;
  for (const OptionText& option : describe_options(command)) {
    if (option.group != group) {
      group = option.group;
      const bool heads = !option.positional && group != "Options";
      page += heads ? ".SS " + roff(group) + "\n" : "";
    }
    std::string names;
    for (const std::string& name : option.names) {
      names += (names.empty() ? "" : ", ") + std::string(option.positional ? "\\fI" : "\\fB") +
               roff(name) + "\\fR";
    }
    const bool shows_value = !option.positional && !option.value.empty();
    page += ".TP\n" + names + (shows_value ? " \\fI" + roff(option.value) + "\\fR" : "") + "\n" +
            roff(option.meaning) + "\n";
  }
  return page;
}

/// The footer of a command: its examples, or what else its help ends with.
std::string closing(const CLI::App& command) {
  const std::string footer = command.get_footer();
  const std::string examples = "Examples:\n";
  const bool shows = footer.starts_with(examples);
  return footer.empty() ? ""
                        : std::string(shows ? ".SH EXAMPLES\n" : ".SH NOTES\n") + ".nf\n" +
                              roff(shows ? footer.substr(examples.size()) : footer) + "\n.fi\n";
}

std::string page_of(const CLI::App& command) {
  const std::string name = dashed(call_of(command));
  std::string page = ".TH " + upper(roff(name)) + " 1 \"\" \"vantage " + std::string(version()) +
                     "\" \"User Commands\"\n.ad l\n.SH NAME\n" + roff(name) + " \\- " +
                     roff(command.get_description()) + "\n.SH SYNOPSIS\n" + synopsis(command);
  const auto below = commands_below(command);
  if (!below.empty()) {
    page += ".SH COMMANDS\n";
    for (const CLI::App* sub : below) {
      page += ".TP\n\\fB" + roff(dashed(call_of(*sub))) + "\\fR(1)\n" +
              roff(sub->get_description()) + "\n";
    }
  }
  page += ".SH OPTIONS\n" + option_entries(command) + closing(command);
  page +=
      ".SH ENVIRONMENT\nEvery option that the command line leaves open is taken from "
      "VANTAGE_\\fICOMMAND\\fR_\\fIOPTION\\fR, else from VANTAGE_\\fIOPTION\\fR (capitals, _ for "
      "\\-), else from the JSON file that \\fB\\-\\-config\\fR or VANTAGE_CONFIG names.\n"
      ".TP\nNO_COLOR\nNo colours in the terminal where it is set.\n";
  return page + (command.get_parent() == nullptr ? "" : ".SH SEE ALSO\n\\fBvantage\\fR(1)\n");
}

void write_pages(const CLI::App& command, const std::filesystem::path& folder) {
  write_file((folder / (dashed(call_of(command)) + ".1")).string(), page_of(command));
  for (const CLI::App* sub : commands_below(command)) {
    write_pages(*sub, folder);
  }
}

struct ManualCommand {
  std::string folder{};
  const CLI::App* program = nullptr;

  void add_flags(CLI::App& app, Session& /*session*/) {
    program = app.get_parent();
    app.group("");  // not for people
    app.add_option("DIR", folder, "existing folder for the pages")->required();
  }

  void run(Session& /*session*/) const { write_pages(*program, folder); }
};

}  // namespace

void add_manual_command(CLI::App& program, Session& session) {
  add_command<ManualCommand>(program, session, "manual", "manual pages", "");
}

}  // namespace vantage::cli
