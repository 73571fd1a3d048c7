// SPDX-License-Identifier: MIT
#include "look_flags.h"

#include <algorithm>

#include "vantage/io/write.h"

#include "output_file.h"

namespace vantage::cli {

void LookFlags::add_to(CLI::App& app, Quality quality, bool asset) {
  set_quality(start_.look, quality);
  start_.look.style = asset ? Style::Asset : Style::Clay;
  flags_.add_groups(app, {"look"}, start_);
  app.add_option("--depth", depth_, "bits a channel of a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str()
      ->group("Pictures");
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

void LookFlags::write(const std::string& path, const Model& model, const ShapeAnalysis& shape,
                      const Camera& camera, Picture picture, const ViewOptions& options,
                      const Vec3& up, const RunContext& run) const {
  const Model* asset = of_asset() ? &model : nullptr;
  write_output(
      path,
      depth_ == 8
          ? picture_bytes(path, draw_picture(shape, camera, picture, options, look(up), run, asset))
          : png_bytes(draw_picture_deep(shape, camera, picture, options, look(up), run, asset)));
}

RenderOptions LookFlags::look(const Vec3& up) const {
  RenderOptions look = resolved().look;
  look.up = up;
  return look;
}

}  // namespace vantage::cli
