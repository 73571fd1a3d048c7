// SPDX-License-Identifier: MIT
#include "usage_hint.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "option_text.h"

namespace vantage::cli {
namespace {

/// Letters to insert, drop, change or swap with their neighbour between two words.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({changed, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
      }
    }
  }
  return edits[a.size()][b.size()];
}

std::string meant(const std::string& nearest) {
  return nearest.empty() ? "; see --help" : "; did you mean " + nearest + "?";
}

/// The flags of a command as they are written, those of its option groups included.
class Flags {
 public:
  explicit Flags(const CLI::App& command) { collect(command); }

  [[nodiscard]] const CLI::Option* find(const std::string& name) const {
    for (const CLI::Option* option : options_) {
      if (!option->get_positional() && option->check_name(name)) {
        return option;
      }
    }
    return nullptr;
  }

  /// How many words that are no flags the command takes.
  [[nodiscard]] std::size_t most_arguments() const {
    std::size_t most = 0;
    for (const CLI::Option* option : options_) {
      most +=
          option->get_positional() ? static_cast<std::size_t>(option->get_items_expected_max()) : 0;
    }
    return most;
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : options_) {
      for (const std::string& name : option->get_lnames()) {
        names.push_back("--" + name);
      }
    }
    return names;
  }

 private:
  void collect(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
      options_.push_back(option);
    }
    for (const CLI::App* group :
         app.get_subcommands([](const CLI::App* below) { return below->get_name().empty(); })) {
      collect(*group);
    }
  }

  std::vector<const CLI::Option*> options_{};
};

/// Which commands know a flag: the end of a sentence about one that does not. Empty if none does.
std::string who_knows(const CLI::App& command, const std::string& flag) {
  const CLI::App* program = &command;
  while (program->get_parent() != nullptr) {
    program = program->get_parent();
  }
  std::vector<std::string> calls;
  for (const CLI::App* other : commands_below(*program)) {
    if (Flags(*other).find(flag) != nullptr) {
      calls.push_back(call_of(*other));
    }
  }
  if (calls.size() > 2) {
    return "; vantage " + calls.front() + " and others have it";
  }
  return calls.empty()       ? ""
         : calls.size() == 1 ? "; vantage " + calls.front() + " has it"
                             : "; vantage " + calls.front() + " and " + calls.back() + " have it";
}

bool takes_value(const CLI::Option& option) {
  return option.get_type_size() != 0 && option.get_expected_max() != 0;
}

bool looks_like_flag(const std::string& word) {
  const bool is_number =
      word.size() > 1 && (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
  return word.size() > 1 && word[0] == '-' && !is_number;
}

/// The first word after the commands that the command does not know.
class Reading {
 public:
  Reading(const CLI::App& command, const std::vector<std::string>& words, std::size_t from)
      : command_(&command), flags_(command), words_(&words), at_(from) {}

  /// \return a sentence, or nothing if all words are known; at() is then beyond them.
  std::optional<std::string> complaint() {
    const std::size_t most = flags_.most_arguments();
    std::size_t arguments = 0;
    for (bool only_arguments = false; at_ < words_->size(); ++at_) {
      const std::string& word = (*words_)[at_];
      if (!only_arguments && word == "--") {
        only_arguments = true;
      } else if (only_arguments || !looks_like_flag(word)) {
        if (++arguments > most) {
          return "'" + word + "' is one argument too many for vantage " + call_of(*command_) +
                 (may_be_output(word) ? "; did you mean -o " + word + "?"
                  : takes_one_model() ? "; vantage batch takes several models"
                                      : "; see --help");
        }
      } else if (auto problem = flag_complaint(word)) {
        return problem;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  /// Whether -o would take the word: it is not given, and there is no such file to be read.
  [[nodiscard]] bool may_be_output(const std::string& word) const {
    std::error_code error;
    return flags_.find("-o") != nullptr && !std::filesystem::exists(word, error) &&
           std::none_of(words_->begin(), words_->end(), [](const std::string& other) {
             return other.starts_with("-o") || other.starts_with("--output");
           });
  }

  /// Whether the command does for one model what batch does for many.
  [[nodiscard]] bool takes_one_model() const {
    return command_->get_name() == "view" || command_->get_name() == "thumb";
  }

  /// Reads a flag, with its value if that is a word of its own.
  std::optional<std::string> flag_complaint(const std::string& word) {
    const std::size_t equals = word.find('=');
    const bool is_long = word.starts_with("--");
    const std::string name = is_long ? word.substr(0, equals) : word.substr(0, 2);
    const CLI::Option* option = flags_.find(name);
    if (option == nullptr) {
      const std::string whole = word.substr(0, equals);
      const std::string flag = is_long ? whole : "-" + whole;  // "-size" for "--size"
      const std::string nearest = nearest_word(flag, flags_.names());
      const std::string elsewhere = nearest.empty() ? who_knows(*command_, flag) : "";
      std::error_code error;
      const bool is_file = std::filesystem::is_regular_file(word, error);
      return "vantage " + call_of(*command_) + " knows no flag " + whole +
             (is_file             ? "; ./" + word + " is the file of this name"
              : elsewhere.empty() ? meant(nearest)
                                  : elsewhere);
    }
    const bool holds_value = is_long ? equals != std::string::npos : word.size() > 2;
    at_ += takes_value(*option) && !holds_value ? 1 : 0;
    return std::nullopt;
  }

  const CLI::App* command_;
  Flags flags_;
  const std::vector<std::string>* words_;
  std::size_t at_;
};

/// Where the flag that a parser's complaint begins with stands; beyond all words if nowhere.
std::size_t place_of_complaint(const std::vector<std::string>& words,
                               const std::string& complaint) {
  const std::string flag = complaint.substr(0, complaint.find_first_of(" :="));
  const auto at = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
    return flag.starts_with('-') && word.substr(0, word.find('=')) == flag;
  });
  return static_cast<std::size_t>(at - words.begin());
}

/// The option of the command that was called; null if it has none of this name.
const CLI::Option* option_called(const CLI::App& program, const std::string& name) {
  const CLI::App* command = &program;
  for (auto called = program.get_subcommands();
       !called.empty() && !called.front()->get_name().empty();
       called = command->get_subcommands()) {
    command = called.front();
  }
  return Flags(*command).find(name);
}

/// A sentence about a command line that ends before it names one of these commands.
std::string missing_command(const CLI::App& before, const std::vector<std::string>& names) {
  if (before.get_parent() == nullptr) {
    return "a command is missing, as in vantage view MODEL; vantage --help lists all";
  }
  const std::string call = "vantage " + call_of(before);
  std::string problem = call + " needs a command:";
  for (const std::string& name : names) {
    problem += " " + name + (name == names.back() ? "; see " + call + " --help" : ",");
  }
  return problem;
}

/// A sentence about a flag in the place of a command; nothing for one that is allowed there.
std::optional<std::string> flag_before_command(const CLI::App& before, const std::string& word) {
  const std::string flag = word.substr(0, word.find('='));
  const Flags own(before);
  if (own.find(flag) != nullptr) {
    return std::nullopt;
  }
  const std::string nearest = flag.starts_with("--") ? nearest_word(flag, own.names()) : "";
  if (!nearest.empty()) {
    return "vantage knows no flag " + flag + meant(nearest);
  }
  return "flags follow a command, and " + flag + " follows none; see --help";
}

}  // namespace

std::string plain_mismatch(const CLI::App& program, const std::string& complaint) {
  const std::string name = complaint.substr(0, complaint.find(':'));
  const CLI::Option* option = name.starts_with("--") ? option_called(program, name) : nullptr;
  if (option == nullptr) {
    return complaint;
  }
  if (complaint.find(": At Most 1 required") != std::string::npos) {
    return name + " is given more than once";
  }
  if (complaint.find(" required ") != std::string::npos && complaint.ends_with(" missing")) {
    return name + " needs a value: " + describe(*option).meaning;
  }
  return complaint;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::vector<std::string> begin_so;
  std::copy_if(known.begin(), known.end(), std::back_inserter(begin_so),
               [&](const std::string& other) { return other.starts_with(word); });
  if (begin_so.size() == 1) {
    return begin_so.front();
  }
  std::string nearest;
  std::size_t fewest = 1 + std::max<std::size_t>(1, word.size() / 3);
  for (const std::string& other : known) {
    const std::size_t edits = edits_between(word, other);
    if (edits < fewest) {
      fewest = edits;
      nearest = other;
    }
  }
  return nearest;
}

std::optional<std::string> unknown_word(const CLI::App& program,
                                        const std::vector<std::string>& words,
                                        const std::string& complaint) {
  const CLI::App* command = &program;
  std::size_t at = 0;
  while (!commands_below(*command).empty()) {
    std::vector<std::string> names;
    for (const CLI::App* sub : commands_below(*command)) {
      names.push_back(sub->get_name());
    }
    if (at == words.size()) {
      return missing_command(*command, names);
    }
    if (looks_like_flag(words[at])) {
      return flag_before_command(*command, words[at]);
    }
    const CLI::App* below = nullptr;
    for (const CLI::App* sub :
         command->get_subcommands([](const CLI::App* any) { return !any->get_name().empty(); })) {
      below = sub->get_name() == words[at] ? sub : below;
    }
    if (below == nullptr) {
      const std::string call = call_of(*command);
      std::error_code error;
      const bool is_file = call.empty() && std::filesystem::is_regular_file(words[at], error);
      return "vantage" + (call.empty() ? "" : " " + call) + " has no command '" + words[at] + "'" +
             meant(is_file ? "vantage view " + words[at] : nearest_word(words[at], names));
    }
    command = below;
    ++at;
  }
  Reading reading(*command, words, at);
  const std::optional<std::string> problem = reading.complaint();
  return problem && reading.at() <= place_of_complaint(words, complaint) ? problem : std::nullopt;
}

}  // namespace vantage::cli
