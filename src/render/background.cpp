// SPDX-License-Identifier: MIT
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

#include "render/hex_text.h"

namespace vantage {
namespace {

// From nearly white above to a light blue grey, so that clay and drawings both stand out. [ours]
constexpr Rgb8 kGradientTop{250, 251, 252};
constexpr Rgb8 kGradientBottom{190, 198, 208};

/// "white", "black", "#rrggbb" or "#rgb"; nothing for any other text.
std::optional<Rgb8> parse_colour(std::string_view text) {
  if (text == "white") {
    return Rgb8{255, 255, 255};
  }
  if (text == "black") {
    return Rgb8{0, 0, 0};
  }
  if (text.size() == 4 && text.front() == '#') {
    const std::string twice{'#', text[1], text[1], text[2], text[2], text[3], text[3]};
    return parse_colour(twice);
  }
  if (text.size() != 7 || text.front() != '#') {
    return std::nullopt;
  }
  Rgb8 colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char* first = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, colour[i], 16);
    if (error != std::errc{} || end != first + 2) {
      return std::nullopt;
    }
  }
  return colour;
}

}  // namespace

void set_background(RenderOptions& options, std::string_view text) {
  std::optional<Rgb8> top;
  std::optional<Rgb8> bottom;
  if (text == "gradient") {
    top = kGradientTop;
    bottom = kGradientBottom;
  } else if (text != "transparent") {
    const std::size_t colon = text.find(':');
    top = parse_colour(text.substr(0, colon));
    const bool two = colon != std::string_view::npos;
    if (two) {
      bottom = parse_colour(text.substr(colon + 1));
    }
    if (!top || (two && !bottom)) {
      throw InvalidInput(
          "option background must be transparent, gradient, white, black, #rgb, #rrggbb, or two of "
          "these "
          "colours as TOP:BOTTOM, not '" +
          std::string(text) + "'");
    }
  }
  options.background = top;
  options.background_bottom = bottom;
}

std::string background_text(const RenderOptions& options) {
  if (!options.background) {
    return "transparent";
  }
  const std::string top = hex_text(*options.background);
  return options.background_bottom ? top + ":" + hex_text(*options.background_bottom) : top;
}

}  // namespace vantage
