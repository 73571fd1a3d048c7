// SPDX-License-Identifier: MIT
#include "look_options.h"

#include <charconv>
#include <string_view>
#include <system_error>

#include "option_makers.h"

namespace vantage::python {
namespace {

// From nearly white above to a light blue grey, as the program's gradient. [ours]
constexpr Rgb8 kGradientTop{250, 251, 252};
constexpr Rgb8 kGradientBottom{190, 198, 208};

/// "white", "black" or "#rrggbb".
Rgb8 parse_colour(std::string_view text) {
  if (text == "white") {
    return {255, 255, 255};
  }
  if (text == "black") {
    return {0, 0, 0};
  }
  Rgb8 colour{};
  bool good = text.size() == 7 && text.front() == '#';
  for (std::size_t i = 0; good && i < 3; ++i) {
    const char* first = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, colour[i], 16);
    good = error == std::errc{} && end == first + 2;
  }
  if (!good) {
    throw InvalidInput(
        "option background must be transparent, gradient, white, black, #rrggbb, or two colours "
        "as TOP:BOTTOM, not '" +
        std::string(text) + "'");
  }
  return colour;
}

void set_background(Settings& s, const py::object& given) {
  const auto text = cast_option<std::string>(given, "background");
  s.look.background.reset();
  s.look.background_bottom.reset();
  if (text == "transparent") {
    return;
  }
  if (text == "gradient") {
    s.look.background = kGradientTop;
    s.look.background_bottom = kGradientBottom;
    return;
  }
  const std::size_t colon = text.find(':');
  s.look.background = parse_colour(std::string_view(text).substr(0, colon));
  if (colon != std::string::npos) {
    s.look.background_bottom = parse_colour(std::string_view(text).substr(colon + 1));
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
                   .set = set_background,
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
