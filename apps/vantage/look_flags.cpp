// SPDX-License-Identifier: MIT
#include "look_flags.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "output_file.h"

namespace vantage::cli {
namespace {

constexpr std::array<const char*, 3> kQualities{"draft", "normal", "fine"};

void take_background(RenderOptions& look, const std::string& text) {
  try {
    set_background(look, text);
  } catch (const InvalidInput& error) {
    throw CLI::ValidationError("--background", error.what());
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
         "--background", [this](const std::string& text) { take_background(look_, text); },
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
  write_output(
      path,
      depth_ == 8
          ? picture_bytes(path, draw_picture(shape, camera, picture, options, look(up), run, asset))
          : png_bytes(draw_picture_deep(shape, camera, picture, options, look(up), run, asset)));
}

RenderOptions LookFlags::look(const Vec3& up) const {
  RenderOptions look = look_;
  look.up = up;
  return look;
}

}  // namespace vantage::cli
