// SPDX-License-Identifier: MIT
#include <string>

#include "commands.h"
#include "option_text.h"
#include "output_file.h"

/// \file
/// `vantage completion bash|zsh|fish`: scripts that shells complete command lines with, written
/// from the very options that the program parses.

namespace vantage::cli {
namespace {

using Commands = std::vector<const CLI::App*>;

/// Commands that run, "results query" instead of "results".
void collect(const CLI::App& app, Commands& leaves) {
  for (const CLI::App* command : commands_below(app)) {
    if (commands_below(*command).empty()) {
      leaves.push_back(command);
    }
    collect(*command, leaves);
  }
}

std::string names_of(const Commands& commands) {
  std::string names;
  for (const CLI::App* command : commands) {
    names += (names.empty() ? "" : " ") + command->get_name();
  }
  return names;
}

/// `text` between single quotes of a POSIX shell.
std::string shell_word(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) {
    safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe + "'";
}

std::string bash_rules(const CLI::App& command) {
  std::string flags;
  std::string values;
  std::string words;
  for (const OptionText& option : describe_options(command)) {
    if (option.positional) {
      words += option.choices.empty()
                   ? ""
                   : "      [[ $current == -* ]] || words=" +
                         shell_word(CLI::detail::join(option.choices, " ")) + "\n";
      continue;
    }
    for (const std::string& name : option.names) {
      flags += (flags.empty() ? "" : " ") + name;
    }
    if (!option.choices.empty()) {
      values += "        " + CLI::detail::join(option.names, "|") +
                (option.value.empty() ? ") ((joined)) && words=" : ") words=") +
                shell_word(CLI::detail::join(option.choices, " ")) +
                (option.joins ? " list=1 ;;\n" : " ;;\n");
    }
  }
  std::string rules = "    " + shell_word(call_of(command)) + ")\n";
  rules += "      flags=" + shell_word(flags) + "\n";
  rules += words;
  rules += values.empty() ? "" : "      case $previous in\n" + values + "      esac\n";
  return rules + "      ;;\n";
}

std::string bash_script(const CLI::App& program) {
  Commands leaves;
  collect(program, leaves);
  std::string rules;
  for (const CLI::App* command : leaves) {
    rules += bash_rules(*command);
  }
  std::string groups;
  for (const CLI::App* command : commands_below(program)) {
    const Commands below = commands_below(*command);
    if (!below.empty()) {
      groups += "    " + command->get_name() + ") words=" + shell_word(names_of(below)) +
                "\n      ((COMP_CWORD > 2)) && words= && call=\"$call ${COMP_WORDS[2]}\" ;;\n";
    }
  }
  return "# bash completion of vantage\n"
         "_vantage() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local call=${COMP_WORDS[1]} words= flags= prefix= list=0 joined=0\n"
         "  # Of --style=clay bash makes three words.\n"
         "  if [[ $current == = ]]; then current= joined=1\n"
         "  elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD-2]} joined=1; fi\n"
         "  COMPREPLY=()\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    words=" +
         shell_word(names_of(commands_below(program)) + " --help --version") +
         "\n  fi\n"
         "  case $call in\n" +
         groups +
         "  esac\n"
         "  case $call in\n" +
         rules +
         "  esac\n"
         "  if [[ -z $words && $current == -* ]]; then words=$flags; fi\n"
         "  if [[ -n $words ]]; then\n"
         "    if ((list)) && [[ $current == *,* ]]; then prefix=${current%,*},; fi\n"
         "    mapfile -t COMPREPLY < <(compgen -P \"$prefix\" -W \"$words\" -- "
         "\"${current#\"$prefix\"}\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "    compopt -o filenames 2>/dev/null\n"
         "  fi\n"
         "}\n"
         "complete -F _vantage vantage\n";
}

/// Text inside the brackets of an _arguments specification.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe +=
        c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return safe;
}

std::string zsh_rules(const CLI::App& command) {
  std::string rules = "    (" + shell_word(call_of(command)) + ")\n      _arguments -S";
  for (const OptionText& option : describe_options(command)) {
    const std::string what =
        option.choices.empty() ? "_files" : "(" + CLI::detail::join(option.choices, " ") + ")";
    if (option.positional) {
      rules += " \\\n        " +
               shell_word((option.repeats ? "*:" : ":") + zsh_text(option.names[0]) + ":" + what);
      continue;
    }
    for (const std::string& name : option.names) {
      std::string rule = (option.repeats ? "*" : "") + name + "[" + zsh_text(option.meaning) + "]";
      rule +=
          option.value.empty() ? "" : ":" + zsh_text(option.names.back().substr(1)) + ":" + what;
      rules += " \\\n        " + shell_word(rule);
    }
  }
  return rules + "\n      ;;\n";
}

std::string zsh_script(const CLI::App& program) {
  Commands leaves;
  collect(program, leaves);
  std::string commands;
  std::string groups;
  for (const CLI::App* command : commands_below(program)) {
    commands +=
        "      " + shell_word(command->get_name() + ":" + command->get_description()) + "\n";
    const Commands below = commands_below(*command);
    if (!below.empty()) {
      groups += "    (" + command->get_name() + ")\n      if ((CURRENT == 3)); then compadd " +
                names_of(below) +
                "; return; fi\n      call=\"$call $words[3]\"; words=(\"${words[@]:1}\"); "
                "((CURRENT--)) ;;\n";
    }
  }
  std::string rules;
  for (const CLI::App* command : leaves) {
    rules += zsh_rules(*command);
  }
  return "#compdef vantage\n"
         "_vantage() {\n"
         "  local call=$words[2]\n"
         "  local -a commands\n"
         "  if ((CURRENT == 2)); then\n"
         "    commands=(\n" +
         commands +
         "    )\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  case $call in\n" +
         groups +
         "  esac\n"
         "  words=(\"${words[@]:1}\"); ((CURRENT--))\n"
         "  case $call in\n" +
         rules +
         "  esac\n"
         "}\n"
         "_vantage \"$@\"\n";
}

/// What completes an option after `call`; nothing for files named by position.
std::string fish_rule(const OptionText& option, const std::string& call) {
  const bool is_offered = !option.choices.empty() && (option.positional || !option.value.empty());
  const std::string choices =
      is_offered ? " -f -a " + shell_word(CLI::detail::join(option.choices, " ")) : "";
  if (option.positional) {
    return choices.empty() ? "" : call + choices + "\n";
  }
  std::string rule = call;
  for (const std::string& name : option.names) {
    rule += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return rule + (option.value.empty() ? "" : " -r") + choices + " -d " +
         shell_word(option.meaning) + "\n";
}

std::string fish_script(const CLI::App& program) {
  std::string script = "# fish completion of vantage\n";
  const std::string complete = "complete -c vantage";
  for (const CLI::App* command : commands_below(program)) {
    script += complete + " -n __fish_use_subcommand -f -a " + command->get_name() + " -d " +
              shell_word(command->get_description()) + "\n";
    for (const CLI::App* below : commands_below(*command)) {
      script += complete + " -n '__fish_seen_subcommand_from " + command->get_name() + "' -f -a " +
                below->get_name() + " -d " + shell_word(below->get_description()) + "\n";
    }
  }
  Commands leaves;
  collect(program, leaves);
  for (const CLI::App* command : leaves) {
    const std::string when = " -n '__fish_seen_subcommand_from " + command->get_name() + "'";
    for (const OptionText& option : describe_options(*command)) {
      script += fish_rule(option, complete + when);
    }
  }
  return script;
}

struct CompletionCommand {
  std::string shell{};
  const CLI::App* program = nullptr;

  void add_flags(CLI::App& app, Session& /*session*/) {
    program = app.get_parent();
    app.add_option("SHELL", shell, "shell to write the script for")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  }

  void run(Session& /*session*/) const {
    write_output("-", shell == "bash"  ? bash_script(*program)
                      : shell == "zsh" ? zsh_script(*program)
                                       : fish_script(*program));
  }
};

}  // namespace

void add_completion_command(CLI::App& program, Session& session) {
  add_command<CompletionCommand>(
      program, session, "completion", "a script that completes command lines in your shell",
      "Examples:\n"
      "  vantage completion bash > /etc/bash_completion.d/vantage\n"
      "  vantage completion zsh > \"${fpath[1]}/_vantage\"\n"
      "  vantage completion fish > ~/.config/fish/completions/vantage.fish");
}

}  // namespace vantage::cli
