// SPDX-License-Identifier: MIT
#include "options.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include "vantage/core/error.h"

#include "text.h"

namespace vantage::python {
namespace {

std::string keyword_of(const Option& option) {
  std::string name = option.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// As the program's command line has it.
std::string flag_of(const Option& option) {
  const OptionValue value = option.value({});
  const bool* const is_on = std::get_if<bool>(&value);
  return (is_on != nullptr && *is_on ? "--no-" : "--") + option.name;
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
      for (const std::string& word : option.words) {
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

/// A text of an option, from all that Python may say it by.
std::string text_from(const Option& option, const py::object& given) {
  if (option.form == TextForm::File) {
    return path_text(given);
  }
  if (py::isinstance<py::str>(given)) {
    return given.cast<std::string>();
  }
  if (option.form == TextForm::Share) {
    return py::repr(py::float_(given)).cast<std::string>();
  }
  if (option.form == TextForm::Size && py::isinstance<py::sequence>(given)) {
    std::string text;
    for (const py::handle side : given) {
      text += (text.empty() ? "" : "x") + py::str(side).cast<std::string>();
    }
    return text;
  }
  if (option.form == TextForm::Plain) {
    throw py::cast_error();
  }
  return py::str(given).cast<std::string>();
}

/// A whole number, from anything that stands for one.
OptionValue whole_from(const Option& option, const py::object& given) {
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!number) {
    PyErr_Clear();
    throw py::cast_error();
  }
  int overflow = 0;
  const long long small = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow == 0 && small < 0) {
    refuse_number(option.name, static_cast<double>(small), option.low, option.high);
  }
  const std::uint64_t whole = PyLong_AsUnsignedLongLong(number.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    constexpr double kBeyond = 0x1p64;
    throw InvalidInput("option " + option.name + " must be between " +
                       std::to_string(static_cast<std::uint64_t>(option.low)) + " and " +
                       std::to_string(option.high < kBeyond
                                          ? static_cast<std::uint64_t>(option.high)
                                          : std::numeric_limits<std::uint64_t>::max()));
  }
  return whole;
}

/// True or False, NumPy's too; numbers are none. \throw py::cast_error
bool switch_from(const py::object& given) {
  py::detail::make_caster<bool> caster;
  if (!caster.load(given, /*convert=*/false)) {
    throw py::cast_error();
  }
  return static_cast<bool>(caster);
}

/// \throw py::cast_error if it is of another type
OptionValue value_from(const Option& option, const py::object& given) {
  switch (option.kind) {
    case OptionKind::Number:
      return given.cast<double>();
    case OptionKind::Integer:
      return whole_from(option, given);
    case OptionKind::Switch:
      return switch_from(given);
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

void apply(Settings& settings, const py::dict& keywords, bool is_analysed) {
  std::set<std::string, std::less<>> changed;  // defaults may be given, and mean nothing
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
    settings.view.view_set = checked_view_set(settings.view);
  } catch (const InvalidInput& error) {
    throw InvalidInput(in_keywords(error.what()));
  }
}

}  // namespace

Settings settings_of(const py::dict& keywords) {
  Settings settings = all_options(Preset::Default);
  apply(settings, keywords, false);
  return settings;
}

Settings settings_over(Settings base, const py::dict& keywords) {
  apply(base, keywords, true);
  return base;
}

py::dict default_values(const std::string& preset) {
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
  const py::dict ours = default_values("default");
  const py::dict papers = default_values("paper");
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
    row["help"] = option.help;
    row["choices"] = option.words;
    row["low"] = is_number ? py::object(py::float_(option.low)) : py::none();
    row["high"] = is_number ? py::object(py::float_(option.high)) : py::none();
    row["default"] = ours[row["name"]];
    row["paper"] = papers[row["name"]];
    rows.append(row);
  }
  return rows;
}

}  // namespace vantage::python
