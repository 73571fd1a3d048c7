// SPDX-License-Identifier: MIT
#include "io/obj_materials.h"

#include <algorithm>
#include <utility>

#include "core/srgb.h"
#include "io/number_parsing.h"

namespace vantage {
namespace {

/// The pixel of an image that lies at pixel (x, y) of one of another size. \pre sides are at most
/// kLargestPictureSide, whose square an int holds.
const std::uint8_t* seen_at(const Image& image, int x, int y, const Image& size) {
  return image.pixel(x * image.width / size.width, y * image.height / size.height);
}

/// The picture seen where the mask is bright, or opaque if it has an alpha channel of its own; as fine as the one
/// that has more pixels.
Image masked(const Image& picture, const Image& mask) {
  bool has_alpha = false;
  for (std::size_t i = 3; i < mask.rgba.size(); i += 4) {
    has_alpha |= mask.rgba[i] < 255;
  }
  Image result = picture.rgba.size() < mask.rgba.size() ? mask : picture;
  std::uint8_t* pixel = result.rgba.data();
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x, pixel += 4) {
      const std::uint8_t* seen = seen_at(mask, x, y, result);
      const int light = (seen[0] + seen[1] + seen[2]) / 3;
      std::copy_n(seen_at(picture, x, y, result), 3, pixel);
      pixel[3] = has_alpha ? seen[3] : static_cast<std::uint8_t>(light);
    }
  }
  return result;
}

}  // namespace

void ObjMaterials::use(std::string_view name) {
  const auto next = static_cast<std::uint32_t>(index_of_name_.size());
  builder_.begin_material(index_of_name_.try_emplace(std::string(name), next).first->second);
}

std::optional<std::string> ObjMaterials::path_of(const MtlMap& map) const {
  return map.name.empty() ? std::nullopt : libraries_.place_of(map.name);
}

std::optional<std::uint32_t> ObjMaterials::texture(const MtlMaterial& source, bool clamp) {
  const std::optional<std::string> picture = path_of(source.picture);
  std::optional<std::string> mask = path_of(source.mask);
  mask = mask == picture ? std::nullopt : std::move(mask);  // its opacity is there already
  const auto [known, is_new] = known_textures_.try_emplace({picture, mask, clamp});
  if (!is_new) {
    return known->second;
  }
  std::optional<Image> image = picture ? loader_.beside(*picture) : std::nullopt;
  if (mask) {
    if (const std::optional<Image> holes = loader_.beside(*mask)) {
      const Image white{1, 1, {255, 255, 255, 255}};
      image = masked(image ? *image : white, *holes);
    }
  }
  if (image) {
    const TextureWrap wrap = clamp ? TextureWrap::Clamp : TextureWrap::Repeat;
    known->second = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back({std::move(*image), wrap, wrap, false});
  }
  return known->second;
}

Material ObjMaterials::material(const MtlMaterial& source) {
  Material result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.colour[c] = linear_of_encoded(source.colour[c]);
  }
  const bool has_picture = !source.picture.name.empty();
  const bool has_mask = !source.mask.name.empty();
  // Programs that put the whole colour into the picture often leave Kd black.
  if (has_picture && source.colour == std::array{0.0, 0.0, 0.0}) {
    result.colour = {1.0, 1.0, 1.0};
  }
  result.opacity = source.opacity;
  result.alpha = source.opacity < 1.0 ? AlphaMode::Blend : AlphaMode::Opaque;
  const MtlMap& laid = has_picture ? source.picture : source.mask;
  masks_laid_otherwise_ += has_picture && has_mask && !source.mask.lies_as(source.picture) ? 1 : 0;
  if (has_picture || has_mask) {
    result.texture = texture(source, laid.clamp);
    if (has_mask && result.texture && result.alpha == AlphaMode::Opaque) {
      result.alpha = AlphaMode::Mask;  // what is glass besides stays glass
    }
  }
  // Wavefront's coordinates begin at the bottom left, ours at the top left.
  result.uv_transform = {laid.scale[0],       0.0, laid.offset[0], 0.0, -laid.scale[1],
                         1.0 - laid.offset[1]};
  return result;
}

void ObjMaterials::finish() {
  libraries_.read();
  const std::vector<std::string>& missing = libraries_.missing();
  const std::size_t told = std::min(missing.size(), kMostTextureNotes);
  for (std::size_t i = 0; i < told; ++i) {
    builder_.note("the material library " + in_quotes(missing[i]) + " was left out: it " +
                  std::string(libraries_.problem()));
  }
  if (told < missing.size()) {
    builder_.note("more material libraries were left out: " +
                  std::to_string(missing.size() - told));
  }
  std::vector<Material> materials(index_of_name_.size());
  std::size_t unknown = 0;
  for (const auto& [name, index] : index_of_name_) {
    const MtlMaterial* const found = libraries_.find(name);
    unknown += found == nullptr ? 1 : 0;
    if (found != nullptr) {
      materials[index] = material(*found);
    }
  }
  loader_.finish();
  if (masks_laid_otherwise_ > 0) {
    builder_.note("masks (map_d) with options of their own, laid as their pictures are: " +
                  std::to_string(masks_laid_otherwise_));
  }
  if (unknown > 0 && missing.empty() && !libraries_.materials().empty()) {
    builder_.note("materials of faces that no material library has: " + std::to_string(unknown));
  }
  if (unknown < materials.size()) {
    builder_.set_materials(std::move(materials), std::move(textures_));
  }
}

}  // namespace vantage
