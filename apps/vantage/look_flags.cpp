// SPDX-License-Identifier: MIT
#include "look_flags.h"

#include <algorithm>

#include "vantage/io/write.h"
#include "vantage/pipeline/option_table.h"

#include "output_file.h"
#include "picture_check.h"

namespace vantage::cli {

void LookFlags::add_to(CLI::App& app, Quality quality) {
  set_quality(start_.look, quality);
  add_to_several(app);
  app.add_option("--depth", depth_, "bits a channel of a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str()
      ->group("Pictures");
}

void LookFlags::add_to_several(CLI::App& app, Style style) {
  if (start_.look.ambient_rays == 0) {
    set_quality(start_.look, Quality::Normal);
  }
  start_.look.style = style;
  flags_.add_groups(app, {"look"}, start_);
}

std::string LookFlags::text() const {
  const AllOptions all = resolved();
  std::string text;
  for (const Option& option : option_table()) {
    const OptionValue value = option.is_of_pictures ? option.value(all) : OptionValue{};
    if (const auto* word = std::get_if<std::string>(&value)) {
      text += option.name + '=' + *word + ' ';
    } else if (const auto* number = std::get_if<double>(&value)) {
      text += option.name + '=' + number_text(*number) + ' ';
    } else if (const auto* whole = std::get_if<std::uint64_t>(&value)) {
      text += option.name + '=' + std::to_string(*whole) + ' ';
    } else if (const auto* on = std::get_if<bool>(&value)) {
      text += option.name + '=' + (*on ? "on " : "off ");
    }
  }
  return text;
}

AllOptions LookFlags::resolved() const {
  AllOptions all = start_;
  flags_.apply(all);
  return all;
}

ReadOptions LookFlags::reading(int width, int height) const {
  // A model shows most of a texture across it, or a part of it closer by. [ours]
  constexpr int kTexelsPerPixel = 4;
  return {.appearance = of_asset(), .texture_side = kTexelsPerPixel * std::max(width, height)};
}

std::string LookFlags::write(const std::string& path, const Model& model,
                             const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                             const ViewOptions& options, const Vec3& up,
                             const RunContext& run) const {
  check_sides(path, options.width, options.height);  // of a size that fits the view
  const Model* asset = of_asset() ? &model : nullptr;
  if (depth_ != 8) {
    const DeepImage image =
        draw_picture_deep(shape, camera, picture, options, look(up), run, asset);
    write_output(path, png_bytes(image));
    return emptiness_warning(image);
  }
  const Image image = draw_picture(shape, camera, picture, options, look(up), run, asset);
  write_output(path, picture_bytes(path, image));
  return emptiness_warning(image);
}

RenderOptions LookFlags::look(const Vec3& up) const {
  RenderOptions look = resolved().look;
  look.up = up;
  return look;
}

}  // namespace vantage::cli
