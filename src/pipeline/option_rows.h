// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

/// \file
/// From the entries of a table of options to rows of the one list.

namespace vantage {

template <class Value>
inline constexpr bool kIsOptional = false;
template <class Value>
inline constexpr bool kIsOptional<std::optional<Value>> = true;

/// The value as a T. \throw InvalidInput naming the option and what it must be.
template <class T>
const T& expected(const OptionValue& value, std::string_view name, const char* what) {
  const T* const held = std::get_if<T>(&value);
  if (held == nullptr) {
    throw InvalidInput("option " + std::string(name) + " must be " + what);
  }
  return *held;
}

// What an entry says in a row.

template <class Options, class Value>
void describe(const Field<Options, Value>& field, Option& row) {
  row.kind = std::is_integral_v<NumberOf<Value>> ? OptionKind::Integer : OptionKind::Number;
  row.low = static_cast<double>(field.low);
  row.high = static_cast<double>(field.high);
  if (!field.unit.empty()) {
    row.help += ", " + std::string(field.unit);
  }
}

template <class Options>
void describe(const Switch<Options>& entry, Option& row) {
  row.kind = OptionKind::Switch;
  row.off_help = std::string(entry.off_help);
}

inline void describe_words(std::string_view words, Option& row) {
  row.kind = OptionKind::Choice;
  row.words.emplace_back(words.substr(0, words.find('|')));
  while (words.find('|') != std::string_view::npos) {
    words.remove_prefix(words.find('|') + 1);
    row.words.emplace_back(words.substr(0, words.find('|')));
  }
}

template <class Options, class Value>
void describe(const Choice<Options, Value>& choice, Option& row) {
  describe_words(choice.words, row);
}

template <class Options>
void describe(const Word<Options>& word, Option& row) {
  row.form = word.form;
}

template <class Options>
void describe(const Text<Options>& text, Option& row) {
  row.form = text.form;
  if (!text.words.empty()) {
    describe_words(text.words, row);
  }
}

// What an entry is in its options.

template <class Number>
OptionValue number_value(Number number) {
  if constexpr (std::is_integral_v<Number>) {
    return static_cast<std::uint64_t>(number);
  } else {
    return number;
  }
}

template <class Options, class Value>
OptionValue value_of(const Field<Options, Value>& field, const Options& options) {
  const Value& value = options.*(field.member);
  if constexpr (kIsOptional<Value>) {
    return value ? number_value(*value) : OptionValue{};
  } else {
    return number_value(value);
  }
}

template <class Options>
OptionValue value_of(const Switch<Options>& entry, const Options& options) {
  return options.*(entry.member);
}

template <class Options, class Value>
OptionValue value_of(const Choice<Options, Value>& choice, const Options& options) {
  const Value& value = options.*(choice.member);
  std::size_t index = std::numeric_limits<std::size_t>::max();  // the last word
  if constexpr (kIsOptional<Value>) {
    index = value ? static_cast<std::size_t>(*value) : index;
  } else {
    index = static_cast<std::size_t>(value);
  }
  return std::string(word_at(choice.words, index));
}

inline OptionValue text_value(std::string text) {
  return text.empty() ? OptionValue{} : OptionValue{std::move(text)};
}

template <class Options>
OptionValue value_of(const Word<Options>& word, const Options& options) {
  return text_value(options.*(word.member));
}

template <class Options>
OptionValue value_of(const Text<Options>& text, const Options& options) {
  return text_value(text.text(options));
}

// How an entry is set.

template <class Options, class Value>
void set_value(const Field<Options, Value>& field, Options& options, const OptionValue& value) {
  using Number = NumberOf<Value>;
  if (kIsOptional<Value> && std::holds_alternative<std::monostate>(value)) {
    options.*(field.member) = Value{};
    return;
  }
  if constexpr (std::is_integral_v<Number>) {
    const auto whole = expected<std::uint64_t>(value, field.name, "a whole number");
    if (whole < static_cast<std::uint64_t>(field.low) ||
        whole > static_cast<std::uint64_t>(field.high)) {
      refuse_number(field.name, static_cast<double>(whole), static_cast<double>(field.low),
                    static_cast<double>(field.high));
    }
    options.*(field.member) = static_cast<Number>(whole);
  } else {
    const auto* const whole = std::get_if<std::uint64_t>(&value);
    const double number = whole != nullptr ? static_cast<double>(*whole)
                                           : expected<double>(value, field.name, "a number");
    check_number(field, number);
    options.*(field.member) = number;
  }
}

template <class Options>
void set_value(const Switch<Options>& entry, Options& options, const OptionValue& value) {
  options.*(entry.member) = expected<bool>(value, entry.name, "true or false");
}

template <class Options, class Value>
void set_value(const Choice<Options, Value>& choice, Options& options, const OptionValue& value) {
  const auto& word = expected<std::string>(value, choice.name, "a word");
  const auto index = index_of_word(choice.words, word);
  if (!index) {
    std::string list;
    for (const char c : choice.words) {
      list += c == '|' ? std::string(", ") : std::string(1, c);
    }
    throw InvalidInput("option " + std::string(choice.name) + " is '" + word +
                       "' but must be one of " + list);
  }
  if constexpr (kIsOptional<Value>) {
    const bool is_last = word_at(choice.words, *index + 1) == word;
    options.*(choice.member) =
        is_last ? Value{} : Value{static_cast<typename Value::value_type>(*index)};
  } else {
    options.*(choice.member) = static_cast<Value>(*index);
  }
}

template <class Options>
void set_value(const Word<Options>& word, Options& options, const OptionValue& value) {
  options.*(word.member) = std::holds_alternative<std::monostate>(value)
                               ? std::string()
                               : expected<std::string>(value, word.name, "a text");
}

template <class Options>
void set_value(const Text<Options>& text, Options& options, const OptionValue& value) {
  text.set(options, expected<std::string>(value, text.name, "a text"));
}

/// Makes rows of tables.
class OptionRows {
 public:
  /// \param read gives the table's options of all. \param edit the same to be changed.
  template <class Table, class Read, class Edit>
  void add(const Table& table, const Read& read, const Edit& edit) {
    for_each_field(table, [&](const auto& entry) { add_entry(entry, read, edit); });
  }

  std::vector<Option> rows{};  ///< So far.

 private:
  template <class Read, class Edit>
  void add_entry(const Group& group, const Read& /*read*/, const Edit& /*edit*/) {
    group_ = group;
  }

  template <class Options, class Value, class Table, class Read, class Edit>
  void add_entry(const Part<Options, Value, Table>& part, const Read& read, const Edit& edit) {
    const auto member = part.member;
    if constexpr (kIsOptional<Value>) {
      using Inner = typename Value::value_type;
      add(
          part.table,
          [=](const AllOptions& all) -> Inner {
            const Value value = read(all).*member;
            return value ? *value : Inner{};
          },
          [=](AllOptions& all) -> Inner& {
            Value& value = edit(all).*member;
            return value ? *value : value.emplace();
          });
    } else {
      add(
          part.table, [=](const AllOptions& all) -> Value { return read(all).*member; },
          [=](AllOptions& all) -> Value& { return edit(all).*member; });
    }
  }

  template <class Entry, class Read, class Edit>
  void add_entry(const Entry& entry, const Read& read, const Edit& edit) {
    Option row{.name = std::string(entry.name),
               .group = std::string(group_.key),
               .heading = std::string(group_.heading),
               .help = std::string(entry.help)};
    describe(entry, row);
    row.value = [=](const AllOptions& all) { return value_of(entry, read(all)); };
    row.set = [=](AllOptions& all, const OptionValue& value) {
      set_value(entry, edit(all), value);
    };
    rows.push_back(std::move(row));
  }

  Group group_{};
};

}  // namespace vantage
