// SPDX-License-Identifier: MIT
#include "look_flags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

namespace vantage::cli {
namespace {

constexpr std::array<const char*, 3> kQualities{"draft", "normal", "fine"};

/// "white", "black" or "#rrggbb".
Rgb8 parse_colour(const std::string& text) {
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
    throw CLI::ValidationError("--background",
                               "expected transparent, gradient, white, black, #rrggbb, or two "
                               "colours as TOP:BOTTOM, found '" +
                                   text + "'");
  }
  return colour;
}

// From nearly white above to a light blue grey, so that clay and drawings both stand out. [ours]
constexpr Rgb8 kGradientTop{250, 251, 252};
constexpr Rgb8 kGradientBottom{190, 198, 208};

void set_background(RenderOptions& look, const std::string& text) {
  look.background.reset();
  look.background_bottom.reset();
  if (text == "transparent") {
    return;
  }
  if (text == "gradient") {
    look.background = kGradientTop;
    look.background_bottom = kGradientBottom;
    return;
  }
  const std::size_t colon = text.find(':');
  look.background = parse_colour(text.substr(0, colon));
  if (colon != std::string::npos) {
    look.background_bottom = parse_colour(text.substr(colon + 1));
  }
}

}  // namespace

void LookFlags::add_to(CLI::App& app, Quality quality, bool asset) {
  asset_ = asset;
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
         "--background", [this](const std::string& text) { set_background(look_, text); },
         "transparent, gradient, white, black, #rrggbb, or two of these colours as TOP:BOTTOM")
      ->default_str("transparent")
      ->group(group);
  app.add_option_function<std::string>(
         "--style",
         [this](const std::string& name) {
           look_.style = name == "technical" ? Style::Technical : Style::Clay;
           asset_ = name == "asset";
         },
         "clay: matt and softly lit; asset: the same in the file's own colours and materials; "
         "technical: a drawing with outlines and sharp edges")
      ->check(CLI::IsMember({"clay", "asset", "technical"}))
      ->default_str(asset ? "asset" : "clay")
      ->group(group);
  app.add_flag("--ground", look_.ground, "a soft shadow on the ground under the model")
      ->group(group);
  app.add_option("--crease", look_.crease_deg,
                 "edges that bend by more are sharp, degrees; 0: facets")
      ->check(CLI::Range(0.0, 80.0))
      ->capture_default_str()
      ->group(group);
  app.add_option("--depth", depth_, "bits a channel of a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--margin", margin_per_cent_,
                 "empty border around the model, per cent of the picture's shorter side")
      ->check(CLI::Range(0.0, 45.0))
      ->capture_default_str()
      ->group(group);
}

ReadOptions LookFlags::reading(int width, int height) const {
  // A model shows most of a texture across it, or a part of it closer by. [ours]
  constexpr int kTexelsPerPixel = 4;
  return {.appearance = asset_, .texture_side = kTexelsPerPixel * std::max(width, height)};
}

void LookFlags::write(const std::string& path, const Model& model, const ShapeAnalysis& shape,
                      const Camera& camera, Picture picture, const ViewOptions& options,
                      const Vec3& up, const RunContext& run) const {
  const Model* asset = asset_ ? &model : nullptr;
  if (depth_ == 8) {
    write_picture(path, draw_picture(shape, camera, picture, options, look(up), run, asset));
  } else {
    write_picture(path, draw_picture_deep(shape, camera, picture, options, look(up), run, asset));
  }
}

RenderOptions LookFlags::look(const Vec3& up) const {
  RenderOptions look = look_;
  look.up = up;
  return look;
}

}  // namespace vantage::cli
