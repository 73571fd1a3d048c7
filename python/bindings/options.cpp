// SPDX-License-Identifier: MIT
#include "options.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "vantage/core/error.h"

#include "arguments.h"
#include "text.h"

namespace vantage::python {
namespace {

std::string keyword_of(const Option& option) {
  std::string name = option.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Words that mean something here. Any up axis would turn the model away from where its arrays are.
std::vector<std::string> words_of(const Option& option) {
  std::vector<std::string> words = option.words;
  if (option.name == "up") {
    std::erase(words, "any");
  }
  return words;
}

/// The option's help without the words that are left out.
std::string help_of(const Option& option) {
  return option.name == "up" ? option.help.substr(0, option.help.find("; any:")) : option.help;
}

/// As Python writes the type.
std::string type_of(const Option& option) {
  switch (option.kind) {
    case OptionKind::Number:
      return "float";
    case OptionKind::Integer:
      return "int";
    case OptionKind::Switch:
      return "bool";
    case OptionKind::Choice: {
      std::string words;
      for (const std::string& word : words_of(option)) {
        words.append(words.empty() ? "\"" : ", \"").append(word).append("\"");
      }
      return "Literal[" + words + "]";
    }
    case OptionKind::Text:
      break;
  }
  switch (option.form) {
    case TextForm::Name:
      return "str | int";
    case TextForm::File:
      return "str | os.PathLike[str]";
    case TextForm::Share:
      return "float | str";
    case TextForm::Size:
      return "tuple[int, int] | int | str";
    case TextForm::Plain:
      break;
  }
  return "str";
}

/// Digits of a whole number; True is none. \throw py::cast_error
std::string whole_text(const py::handle& given) {
  if (is_switch(given) || PyIndex_Check(given.ptr()) == 0) {
    throw py::cast_error();
  }
  return py::str(given).cast<std::string>();
}

/// A text of an option, from all that Python may say it by.
std::string text_from(const Option& option, const py::object& given) {
  if (option.form == TextForm::File) {
    return path_text(given);
  }
  if (py::isinstance<py::str>(given)) {
    return given.cast<std::string>();
  }
  if (option.form == TextForm::Share && !is_switch(given)) {
    return py::repr(py::cast(given.cast<double>())).cast<std::string>();
  }
  if (option.form == TextForm::Plain) {
    throw py::cast_error();
  }
  if (option.form == TextForm::Size && PySequence_Check(given.ptr()) != 0 &&
      !py::isinstance<py::bytes>(given)) {
    std::string text;
    for (const py::handle side : given) {
      text += (text.empty() ? "" : "x") + whole_text(side);
    }
    return text;
  }
  return whole_text(given);
}

/// A whole number, from anything that stands for one.
OptionValue whole_from(const Option& option, const py::object& given) {
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!number) {
    refuse_type("option " + keyword_of(option) + " must be " + type_of(option));
  }
  int overflow = 0;
  const long long small = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  const bool is_below = overflow < 0 || (overflow == 0 && small < 0);
  const std::uint64_t whole = is_below ? 0 : PyLong_AsUnsignedLongLong(number.ptr());
  if (is_below || PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    constexpr double kBeyond = 0x1p64;
    throw InvalidInput(
        "option " + option.name + (overflow == 0 ? " is " + std::to_string(small) + " but" : "") +
        " must be between " + std::to_string(static_cast<std::uint64_t>(option.low)) + " and " +
        std::to_string(option.high < kBeyond ? static_cast<std::uint64_t>(option.high)
                                             : std::numeric_limits<std::uint64_t>::max()));
  }
  return whole;
}

/// \throw py::cast_error, py::type_error if it is of another type
OptionValue value_from(const Option& option, const py::object& given) {
  const bool is_number = option.kind == OptionKind::Number || option.kind == OptionKind::Integer;
  if (is_number && is_switch(given)) {
    throw py::cast_error();
  }
  switch (option.kind) {
    case OptionKind::Number:
      return given.cast<double>();
    case OptionKind::Integer:
      return whole_from(option, given);
    case OptionKind::Switch:
      return switch_of(given, "option " + keyword_of(option));
    case OptionKind::Choice:
      return given.cast<std::string>();
    case OptionKind::Text:
      break;
  }
  return text_from(option, given);
}

py::object object_of(const Option& option, const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    if (option.form == TextForm::Size && !text->starts_with("auto")) {
      const std::size_t x = text->find('x');
      return py::make_tuple(std::stoi(text->substr(0, x)), std::stoi(text->substr(x + 1)));
    }
    if (option.form == TextForm::Share && !text->ends_with('%')) {
      return py::float_(py::str(*text));
    }
  }
  return py::cast(value);
}

bool is_given(const py::dict& keywords, const std::string& keyword) {
  return keywords.contains(keyword) && !keywords[py::str(keyword)].is_none();
}

/// A complaint about an option, by its keyword.
std::string in_keywords(std::string what) {
  constexpr std::size_t kName = std::string_view("option ").size();
  if (what.starts_with("option ")) {
    std::replace(what.begin() + kName,
                 what.begin() + static_cast<std::ptrdiff_t>(what.find(' ', kName)), '-', '_');
  }
  return what;
}

/// \throw py::type_error, InvalidInput
void set_option(Settings& settings, const Option& option, const py::object& given) {
  try {
    option.set(settings, value_from(option, given));
  } catch (const py::cast_error&) {
    throw py::type_error("option " + keyword_of(option) + " must be " + type_of(option));
  } catch (const InvalidInput& error) {
    throw InvalidInput(in_keywords(error.what()));
  }
}

/// Names of options that are not as they were before.
using Names = std::set<std::string, std::less<>>;

void refuse_idle(const std::vector<IdleOptions>& idle, const Names& changed) {
  for (const IdleOptions& options : idle) {
    for (const std::string& name : options.names) {
      if (changed.contains(name)) {
        throw InvalidInput("option " + name + " " + options.why);
      }
    }
  }
}

void apply(Settings& settings, const py::dict& keywords, bool is_analysed, const IdleRule& idle) {
  Names changed;  // defaults may be given, and mean nothing
  for (const Option& option : option_table()) {
    const std::string keyword = keyword_of(option);
    if (!option.is_listed() || !is_given(keywords, keyword)) {
      continue;
    }
    if (is_analysed && (option.group == "method" || option.group == "map")) {
      throw InvalidInput("option " + keyword +
                         " shapes the analysis; give it to analyse() instead");
    }
    const OptionValue before = option.value(settings);
    set_option(settings, option, keywords[py::str(keyword)]);
    if (option.value(settings) != before) {
      changed.insert(option.name);
    }
  }
  try {
    check_together(settings.view, [&](std::string_view name) { return changed.contains(name); });
    if (settings.view.search.strategy != SearchStrategy::Gradient) {
      refuse_idle({{{"seed"}, "goes with search gradient only"}}, changed);
    }
    settings.view.view_set = checked_view_set(settings.view);
    if (idle) {
      refuse_idle(idle(settings), changed);
    }
  } catch (const InvalidInput& error) {
    throw InvalidInput(in_keywords(error.what()));
  }
}

}  // namespace

Settings settings_of(const py::dict& keywords, const IdleRule& idle) {
  Settings settings = all_options(Preset::Default);
  apply(settings, keywords, false, idle);
  return settings;
}

Settings settings_over(Settings base, const py::dict& keywords, const IdleRule& idle) {
  apply(base, keywords, true, idle);
  return base;
}

py::dict default_values(const py::object& preset) {
  py::dict keywords;
  keywords["preset"] = preset;
  const Settings settings = settings_of(keywords);
  py::dict values;
  for (const Option& option : option_table()) {
    if (option.is_listed()) {
      values[py::str(keyword_of(option))] = object_of(option, option.value(settings));
    }
  }
  return values;
}

py::list option_rows() {
  const py::dict ours = default_values(py::none());
  const py::dict papers = default_values(py::str("paper"));
  py::list rows;
  for (const Option& option : option_table()) {
    if (!option.is_listed()) {
      continue;
    }
    const bool is_number = option.kind == OptionKind::Number || option.kind == OptionKind::Integer;
    py::dict row;
    row["name"] = keyword_of(option);
    row["flag"] = flag_of(option);
    row["group"] = option.group;
    row["type"] = type_of(option);
    row["help"] = help_of(option);
    row["choices"] = words_of(option);
    row["low"] = is_number ? py::object(py::float_(option.low)) : py::none();
    row["high"] = is_number ? py::object(py::float_(option.high)) : py::none();
    row["default"] = ours[row["name"]];
    row["paper"] = papers[row["name"]];
    rows.append(row);
  }
  return rows;
}

}  // namespace vantage::python
