// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/core/fields.h"

#include "options.h"

/// \file
/// How rows of the table are made: numbers from the library's own field tables, words from lists.

namespace vantage::python {

/// `value` as a number or a truth. \throw py::type_error naming the keyword.
template <class Value>
Value cast_option(const py::object& value, const std::string& name) {
  try {
    if constexpr (std::is_same_v<Value, bool>) {
      if (!py::isinstance<py::bool_>(value)) {
        throw py::cast_error();
      }
    }
    return value.cast<Value>();
  } catch (const py::cast_error&) {
    const std::string wanted = std::is_same_v<Value, bool>          ? "True or False"
                               : std::is_same_v<Value, int>         ? "an integer"
                               : std::is_same_v<Value, std::string> ? "a string"
                                                                    : "a number";
    throw py::type_error("option " + name + " must be " + wanted);
  }
}

/// A number in a range. \param reach gives the number in Settings.
template <class Value, class Reach>
Option number_option(std::string name, std::string group, std::string help, Value low, Value high,
                     Reach reach) {
  Option option{.name = std::move(name), .group = std::move(group), .help = std::move(help)};
  option.type = std::is_same_v<Value, int> ? "int" : "float";
  option.low = static_cast<double>(low);
  option.high = static_cast<double>(high);
  option.set = [reach, low, high, label = option.name](Settings& s, const py::object& given) {
    const auto value = cast_option<Value>(given, label);
    if (!(value >= low && value <= high)) {
      throw InvalidInput("option " + label + " is " + py::str(given).cast<std::string>() +
                         " but must be between " + py::str(py::cast(low)).cast<std::string>() +
                         " and " + py::str(py::cast(high)).cast<std::string>());
    }
    reach(s) = value;
  };
  option.value = [reach](const Settings& s) {
    Settings copy = s;
    return py::cast(reach(copy));
  };
  return option;
}

/// The numbers of one of the library's field tables. \param part gives the options struct.
template <class Table, class Part>
void add_fields(std::vector<Option>& table, const std::string& group, const Table& fields,
                Part part) {
  for_each_field(fields, [&](const auto& field) {
    std::string name(field.name);
    std::replace(name.begin(), name.end(), '-', '_');
    const auto member = field.member;
    table.push_back(number_option(
        std::move(name), group, std::string(field.help), field.low, field.high,
        [ part, member ](Settings & s) -> auto& { return part(s).*member; }));
  });
}

/// True or False. \param reach gives the switch in Settings.
template <class Reach>
Option switch_option(std::string name, std::string group, std::string help, Reach reach) {
  Option option{.name = std::move(name), .group = std::move(group), .help = std::move(help)};
  option.type = "bool";
  option.set = [reach, label = option.name](Settings& s, const py::object& given) {
    reach(s) = cast_option<bool>(given, label);
  };
  option.value = [reach](const Settings& s) {
    Settings copy = s;
    return py::cast(static_cast<bool>(reach(copy)));
  };
  return option;
}

/// One word of a list. \param set takes its index. \param index gives it back.
template <class Set, class Index>
Option word_option(std::string name, std::string group, std::string help,
                   std::vector<std::string> choices, Set set, Index index) {
  Option option{.name = std::move(name),
                .group = std::move(group),
                .help = std::move(help),
                .choices = std::move(choices)};
  for (const std::string& choice : option.choices) {
    option.type += (option.type.empty() ? "Literal[\"" : ", \"") + choice + "\"";
  }
  option.type += "]";
  option.set = [set, label = option.name, words = option.choices](Settings& s,
                                                                  const py::object& given) {
    const auto word = cast_option<std::string>(given, label);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
      std::string list;
      for (const std::string& choice : words) {
        list += (list.empty() ? "" : ", ") + choice;
      }
      throw InvalidInput("option " + label + " is '" + word + "' but must be one of " + list);
    }
    set(s, static_cast<std::size_t>(found - words.begin()));
  };
  option.value = [index, words = option.choices](const Settings& s) {
    return py::cast(words.at(static_cast<std::size_t>(index(s))));
  };
  return option;
}

}  // namespace vantage::python
