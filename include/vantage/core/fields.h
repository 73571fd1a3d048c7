// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "vantage/core/error.h"

/// \file
/// One table per options struct, beside its declaration. Range checks, command line flags and their
/// help, completions, settings, Python's keywords, the echo of the options in results and their hash
/// are all made by walking it (vantage/pipeline/option_table.h). To add an option, add a member and a
/// line of the table. Its default is what its member begins as.

namespace vantage {

/// Help of an entry that has no flag and no keyword: presets set it, results echo it.
inline constexpr const char* kNoFlag = "";

/// The number that an optional number may hold.
template <class Value>
struct NumberIn {
  using type = Value;
};

template <class Value>
struct NumberIn<std::optional<Value>> {
  using type = Value;
};
template <class Value>
using NumberOf = typename NumberIn<Value>::type;

/// A number, or an optional number.
template <class Options, class Value>
struct Field {
  std::string_view name;    ///< Flag name without dashes, e.g. "contraction-growth".
  Value Options::*member;   ///< Where the value lives.
  NumberOf<Value> low;      ///< Smallest allowed value.
  NumberOf<Value> high;     ///< Largest allowed value.
  std::string_view help;    ///< One line: meaning, source.
  std::string_view unit{};  ///< As the help says it; empty: a plain number.
};

/// True or false. What begins as true has a flag `--no-NAME`.
template <class Options>
struct Switch {
  std::string_view name;        ///< As in Field.
  bool Options::*member;        ///< As in Field.
  std::string_view help;        ///< What it does where it is on.
  std::string_view off_help{};  ///< What `--no-NAME` does.
};

/// One of several words: an enumeration, an optional one, or a bool.
template <class Options, class Value>
struct Choice {
  std::string_view name;   ///< As in Field.
  Value Options::*member;  ///< As in Field.
  /// "first|second|…" in the order of the enumerators, for a bool that of false first; the last is
  /// that of an optional one that is unset.
  std::string_view words;
  std::string_view help;  ///< As in Field.
};

/// What texts of an option look like.
enum class TextForm {
  Plain,  ///< Any text.
  Name,   ///< A name, or a number in its place.
  File,   ///< A word, or the name of a file.
  Share,  ///< A number, or a number and %.
  Size,   ///< "800x600", or one number for both sides.
};

/// A text as it is.
template <class Options>
struct Word {
  std::string_view name;            ///< As in Field.
  std::string Options::*member;     ///< As in Field; empty where nothing is set.
  std::string_view help;            ///< As in Field.
  TextForm form = TextForm::Plain;  ///< What texts look like.
};

/// What is written as a text and stands in no single member.
template <class Options>
struct Text {
  std::string_view name;  ///< As in Field.
  /// Takes a text. \throw InvalidInput that begins with "option NAME"
  void (*set)(Options&, std::string_view);
  std::string (*text)(const Options&);  ///< Gives it back; empty where nothing is set.
  std::string_view help;                ///< As in Field.
  TextForm form = TextForm::Plain;      ///< What texts look like.
  std::string_view words{};             ///< "first|second|…" if only these are allowed.
};

/// Options in a member of their own, or in an optional one: its table.
template <class Options, class Value, class Table>
struct Part {
  Value Options::*member;  ///< Where they live.
  Table table;             ///< What they are.
};

/// A heading: the entries that follow belong to it.
struct Group {
  std::string_view key;      ///< Which commands and functions offer it.
  std::string_view heading;  ///< In the help.
};

// Clang 14 needs spelled out what is deduced.
template <class Options, class Value>
Field(const char*, Value Options::*, NumberOf<Value>, NumberOf<Value>, const char*)
    -> Field<Options, Value>;
template <class Options, class Value>
Field(const char*, Value Options::*, NumberOf<Value>, NumberOf<Value>, const char*, const char*)
    -> Field<Options, Value>;
template <class Options>
Switch(const char*, bool Options::*, const char*) -> Switch<Options>;
template <class Options>
Switch(const char*, bool Options::*, const char*, const char*) -> Switch<Options>;
template <class Options, class Value>
Choice(const char*, Value Options::*, const char*, const char*) -> Choice<Options, Value>;
template <class Options>
Word(const char*, std::string Options::*, const char*) -> Word<Options>;
template <class Options>
Word(const char*, std::string Options::*, const char*, TextForm) -> Word<Options>;
template <class Options>
Text(const char*, void (*)(Options&, std::string_view), std::string (*)(const Options&),
     const char*) -> Text<Options>;
template <class Options>
Text(const char*, void (*)(Options&, std::string_view), std::string (*)(const Options&),
     const char*, TextForm) -> Text<Options>;
template <class Options>
Text(const char*, void (*)(Options&, std::string_view), std::string (*)(const Options&),
     const char*, TextForm, const char*) -> Text<Options>;
template <class Options, class Value, class Table>
Part(Value Options::*, Table) -> Part<Options, Value, Table>;

/// Word `index` of "first|second|…", or the last one.
std::string_view word_at(std::string_view words, std::size_t index);
/// The place of `word` in "first|second|…", if it is there.
std::optional<std::size_t> index_of_word(std::string_view words, std::string_view word);

/// \throw InvalidInput: "option NAME is VALUE but must be between LOW and HIGH".
[[noreturn]] void refuse_number(std::string_view name, double value, double low, double high);

/// Calls `visit(entry)` for each entry of the table, in order.
template <class Table, class Visitor>
constexpr void for_each_field(const Table& table, Visitor&& visit) {
  std::apply([&](const auto&... entry) { (visit(entry), ...); }, table);
}

/// Whether an entry of a table is a number.
template <class Entry>
inline constexpr bool kIsNumber = false;
template <class Options, class Value>
inline constexpr bool kIsNumber<Field<Options, Value>> = true;

/// Calls `visit(field)` for each number of the table, in order.
template <class Table, class Visitor>
constexpr void for_each_number(const Table& table, Visitor&& visit) {
  for_each_field(table, [&](const auto& entry) {
    if constexpr (kIsNumber<std::remove_cvref_t<decltype(entry)>>) {
      visit(entry);
    }
  });
}

/// Checks a number against the range of its field; NaN is outside every range.
/// \throw InvalidInput naming the option, the number and its range.
template <class Options, class Value>
void check_number(const Field<Options, Value>& field, NumberOf<Value> number) {
  if (!(number >= field.low && number <= field.high)) {
    refuse_number(field.name, static_cast<double>(number), static_cast<double>(field.low),
                  static_cast<double>(field.high));
  }
}

/// Checks each number of `options` against its range; those of parts are left to who takes them.
/// \throw InvalidInput naming the option, its value and its range.
template <class Options, class Table>
void check_fields(const Options& options, const Table& table) {
  for_each_number(table, [&](const auto& field) {
    const auto& value = options.*(field.member);
    if constexpr (requires { value.has_value(); }) {
      if (value) {
        check_number(field, *value);
      }
    } else {
      check_number(field, value);
    }
  });
}

}  // namespace vantage
