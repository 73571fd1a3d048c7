// SPDX-License-Identifier: MIT
#include "io/obj_materials.h"

#include <algorithm>
#include <utility>

#include "core/srgb.h"
#include "io/number_parsing.h"

namespace vantage {
namespace {

/// The picture, or a white one, seen where the mask is bright, or opaque if it has an alpha channel of its own.
Image masked(std::optional<Image> picture, const Image& mask) {
  Image result =
      picture ? std::move(*picture)
              : Image{mask.width, mask.height, std::vector<std::uint8_t>(mask.rgba.size(), 255)};
  bool has_alpha = false;
  for (std::size_t i = 3; i < mask.rgba.size(); i += 4) {
    has_alpha |= mask.rgba[i] < 255;
  }
  const auto width = static_cast<std::size_t>(result.width);
  const auto height = static_cast<std::size_t>(result.height);
  const auto mask_width = static_cast<std::size_t>(mask.width);
  for (std::size_t y = 0; y < height; ++y) {
    const std::size_t row = y * static_cast<std::size_t>(mask.height) / height;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* seen = &mask.rgba[4 * (row * mask_width + x * mask_width / width)];
      const int light = (seen[0] + seen[1] + seen[2]) / 3;
      result.rgba[4 * (y * width + x) + 3] = has_alpha ? seen[3] : static_cast<std::uint8_t>(light);
    }
  }
  return result;
}

}  // namespace

void ObjMaterials::use(std::string_view name) {
  const auto next = static_cast<std::uint32_t>(index_of_name_.size());
  builder_.begin_material(index_of_name_.try_emplace(std::string(name), next).first->second);
}

std::optional<Image> ObjMaterials::picture(const std::string& name) {
  const std::optional<std::string> path = name.empty() ? std::nullopt : libraries_.place_of(name);
  return path ? loader_.beside(*path) : std::nullopt;
}

std::optional<std::uint32_t> ObjMaterials::texture(const MtlMaterial& source) {
  const std::string key = source.picture + (source.clamp ? " clamped " : " ") + source.mask;
  if (const auto known = known_pictures_.find(key); known != known_pictures_.end()) {
    return known->second;
  }
  std::optional<std::uint32_t>& place = known_pictures_[key];
  std::optional<Image> image = picture(source.picture);
  if (source.mask != source.picture) {
    if (const std::optional<Image> mask = picture(source.mask)) {
      image = masked(std::move(image), *mask);
    }
  }
  if (image) {
    const TextureWrap wrap = source.clamp ? TextureWrap::Clamp : TextureWrap::Repeat;
    place = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back({std::move(*image), wrap, wrap, false});
  }
  return place;
}

Material ObjMaterials::material(const MtlMaterial& source) {
  Material result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.colour[c] = linear_of_encoded(source.colour[c]);
  }
  // Programs that put the whole colour into the picture often leave Kd black.
  if (!source.picture.empty() && source.colour == std::array{0.0, 0.0, 0.0}) {
    result.colour = {1.0, 1.0, 1.0};
  }
  result.opacity = source.opacity;
  result.alpha = source.opacity < 1.0 ? AlphaMode::Blend : AlphaMode::Opaque;
  if (!source.picture.empty() || !source.mask.empty()) {
    result.texture = texture(source);
    if (!source.mask.empty() && result.texture && result.alpha == AlphaMode::Opaque) {
      result.alpha = AlphaMode::Mask;  // what is glass besides stays glass
    }
  }
  // Wavefront's coordinates begin at the bottom left, ours at the top left.
  result.uv_transform = {source.scale[0],       0.0, source.offset[0], 0.0, -source.scale[1],
                         1.0 - source.offset[1]};
  return result;
}

void ObjMaterials::finish() {
  libraries_.read();
  const std::vector<std::string>& missing = libraries_.missing();
  const std::size_t told = std::min(missing.size(), kMostTextureNotes);
  for (std::size_t i = 0; i < told; ++i) {
    builder_.note("the material library " + in_quotes(missing[i]) +
                  " was left out: it cannot be read in the model's folder");
  }
  if (told < missing.size()) {
    builder_.note("more material libraries were left out: " +
                  std::to_string(missing.size() - told));
  }
  std::vector<Material> materials(index_of_name_.size());
  std::size_t unknown = 0;
  for (const auto& [name, index] : index_of_name_) {
    const auto found = libraries_.materials().find(name);
    unknown += found == libraries_.materials().end() ? 1 : 0;
    if (found != libraries_.materials().end()) {
      materials[index] = material(found->second);
    }
  }
  loader_.finish();
  if (unknown > 0 && missing.empty() && !libraries_.materials().empty()) {
    builder_.note("materials of faces that no material library has: " + std::to_string(unknown));
  }
  if (unknown < materials.size()) {
    builder_.set_materials(std::move(materials), std::move(textures_));
  }
}

}  // namespace vantage
