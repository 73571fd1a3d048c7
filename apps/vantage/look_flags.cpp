// SPDX-License-Identifier: MIT
#include "look_flags.h"

#include <array>
#include <charconv>
#include <optional>
#include <string_view>

namespace vantage::cli {
namespace {

constexpr std::array<const char*, 3> kQualities{"draft", "normal", "fine"};

/// "white", "black", "transparent" or "#rrggbb".
std::optional<Rgb8> parse_background(const std::string& text) {
  if (text == "transparent") {
    return std::nullopt;
  }
  if (text == "white") {
    return Rgb8{255, 255, 255};
  }
  if (text == "black") {
    return Rgb8{0, 0, 0};
  }
  Rgb8 colour{};
  bool good = text.size() == 7 && text.front() == '#';
  for (std::size_t i = 0; good && i < 3; ++i) {
    const char* first = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, colour[i], 16);
    good = error == std::errc{} && end == first + 2;
  }
  if (!good) {
    throw CLI::ValidationError(
        "--background", "expected white, black, transparent or #rrggbb, found '" + text + "'");
  }
  return colour;
}

}  // namespace

void LookFlags::add_to(CLI::App& app, Quality quality) {
  const std::string group = "Pictures";
  set_quality(look_, quality);
  app.add_option_function<std::string>(
         "--quality",
         [this](const std::string& name) {
           for (std::size_t i = 0; i < kQualities.size(); ++i) {
             if (name == kQualities[i]) {
               set_quality(look_, static_cast<Quality>(i));
             }
           }
         },
         "rays spent on each pixel: draft, normal or fine")
      ->check(CLI::IsMember({"draft", "normal", "fine"}))
      ->default_str(kQualities[static_cast<std::size_t>(quality)])
      ->group(group);
  app.add_option_function<std::string>(
         "--background",
         [this](const std::string& text) { look_.background = parse_background(text); },
         "white, black, transparent or #rrggbb")
      ->default_str("transparent")
      ->group(group);
}

}  // namespace vantage::cli
