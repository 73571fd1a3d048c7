// SPDX-License-Identifier: MIT
#include "look_options.h"

#include <string>

#include "option_makers.h"

namespace vantage::python {
namespace {

void take_background(Settings& s, const py::object& given) {
  const auto text = cast_option<std::string>(given, "background");
  try {
    set_background(s.look, text);
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("option background: ") + error.what());
  }
}

/// Only asked of presets, which all leave it transparent.
py::object background_name(const Settings& settings) {
  return settings.look.background ? py::object(py::none()) : py::str("transparent");
}

Option quality_option() {
  Option option = word_option(
      "quality", "look", "rays spent on each pixel", {"draft", "normal", "fine"},
      [](Settings& s, std::size_t i) { set_quality(s.look, static_cast<Quality>(i)); },
      [](const Settings&) { return Quality::Normal; });
  return option;
}

Option style_option() {
  return word_option(
      "style", "look",
      "clay: matt and softly lit; asset: the same in the file's own colours; technical: a drawing "
      "with outlines and sharp edges",
      {"clay", "asset", "technical"},
      [](Settings& s, std::size_t i) {
        s.look.style = i == 2 ? Style::Technical : Style::Clay;
        s.asset_colours = i == 1;
      },
      [](const Settings& s) {
        return s.look.style == Style::Technical ? 2 : static_cast<int>(s.asset_colours);
      });
}

}  // namespace

void add_look_options(std::vector<Option>& table) {
  table.push_back(quality_option());
  table.push_back({.name = "background",
                   .group = "look",
                   .type = "str",
                   .help = "transparent, gradient, white, black, #rrggbb, or two of these colours "
                           "as TOP:BOTTOM; unset: transparent",
                   .set = take_background,
                   .value = background_name});
  table.push_back(style_option());
  table.push_back(switch_option(
      "ground", "look", "a soft shadow on the ground under the model",
      [](Settings & s) -> auto& { return s.look.ground; }));
  table.push_back(number_option(
      "crease", "look", "edges that bend by more are sharp, degrees; 0: facets", 0.0, 80.0,
      [](Settings & s) -> auto& { return s.look.crease_deg; }));
  Option margin = number_option(
      "margin", "look", "empty border around the model, per cent of the picture's shorter side",
      0.0, 45.0, [](Settings & s) -> auto& { return s.view.margin; });
  margin.set = [check = margin.set](Settings& s, const py::object& given) {
    check(s, given);
    s.view.margin /= 100.0;
  };
  margin.value = [](const Settings& s) { return py::cast(100.0 * s.view.margin); };
  table.push_back(std::move(margin));
}

}  // namespace vantage::python
