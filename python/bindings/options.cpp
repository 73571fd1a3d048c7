// SPDX-License-Identifier: MIT
#include "options.h"

#include <string>

#include "look_options.h"
#include "option_makers.h"

namespace vantage::python {
namespace {

Settings start_of(Preset preset) {
  Settings settings;
  settings.view = preset_options(preset);
  set_quality(settings.look, Quality::Normal);
  return settings;
}

Option preset_option() {
  return word_option(
      "preset", std::string(kMethodGroup), "default: our choices; paper: the paper's",
      {"default", "paper"},
      [](Settings& s, std::size_t i) { s = start_of(static_cast<Preset>(i)); },
      [](const Settings& s) { return s.view.preset; });
}

std::vector<Option> make_table() {
  std::vector<Option> table;
  table.push_back(preset_option());  // what the others then change
  add_method_options(table);
  add_view_options(table);
  add_look_options(table);
  return table;
}

bool shapes_analysis(const Option& option) {
  return option.group == kMethodGroup || option.group == kMapGroup;
}

void apply(Settings& settings, const py::dict& keywords, bool is_analysed) {
  for (const Option& option : option_table()) {
    if (!keywords.contains(option.name)) {
      continue;
    }
    const py::object value = keywords[py::str(option.name)];
    if (value.is_none()) {
      continue;
    }
    if (is_analysed && shapes_analysis(option)) {
      throw InvalidInput("option " + option.name +
                         " shapes the analysis; give it to analyse() instead");
    }
    option.set(settings, value);
  }
  finish_view_set(settings);
}

}  // namespace

const std::vector<Option>& option_table() {
  static const std::vector<Option> kTable = make_table();
  return kTable;
}

Settings settings_of(const py::dict& keywords) {
  Settings settings = start_of(Preset::Default);
  apply(settings, keywords, false);
  return settings;
}

Settings settings_over(Settings base, const py::dict& keywords) {
  apply(base, keywords, true);
  return base;
}

}  // namespace vantage::python
