// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/io/model.h"

#include "mesh/texture_place.h"

namespace vantage {
namespace {

/// Less opacity than this leaves nothing to be seen in 8 bits a channel on most screens. [ours]
constexpr double kLeastOpacity = 0.01;

/// Place on a texture side of `size` pixels.
int texel_of(double along, int size, TextureWrap wrap) {
  const double turns = std::floor(along);
  double place = wrap == TextureWrap::Clamp ? std::clamp(along, 0.0, 1.0) : along - turns;
  if (wrap == TextureWrap::Mirror && std::fmod(std::abs(turns), 2.0) == 1.0) {
    place = 1.0 - place;
  }
  return std::clamp(static_cast<int>(place * size), 0, size - 1);
}

double alpha_at(const Texture& texture, double u, double v) {
  if (texture.image.rgba.empty()) {
    return 1.0;
  }
  const int x = texel_of(u, texture.image.width, texture.wrap_u);
  const int y = texel_of(v, texture.image.height, texture.wrap_v);
  return texture.image.pixel(x, y)[3] / 255.0;
}

/// Largest opacities of whole textures that were asked for before.
using KnownAlphas = std::vector<std::optional<double>>;

double largest_alpha(const Texture& texture) {
  std::uint8_t largest = 0;
  for (std::size_t i = 3; i < texture.image.rgba.size(); i += 4) {
    largest = std::max(largest, texture.image.rgba[i]);
  }
  return largest / 255.0;
}

/// The largest opacity of a texture found at places of a face.
double largest_alpha(const Appearance& appearance, const Material& material, std::size_t face,
                     KnownAlphas& known) {
  const Texture& texture = appearance.textures[*material.texture];
  const bool has_uvs =
      face < appearance.uv_of_triangle.size() &&
      std::none_of(appearance.uv_of_triangle[face].begin(), appearance.uv_of_triangle[face].end(),
                   [](std::uint32_t uv) { return uv == Appearance::kNone; });
  if (!has_uvs) {
    std::optional<double>& of_all = known[*material.texture];
    of_all = of_all ? of_all : largest_alpha(texture);
    return *of_all;
  }
  constexpr int kSteps = 8;  // places along each side
  double largest = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const std::array<double, 3> weights{static_cast<double>(kSteps - i - j) / kSteps,
                                          static_cast<double>(i) / kSteps,
                                          static_cast<double>(j) / kSteps};
      double u = 0.0;
      double v = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& uv = appearance.uvs[appearance.uv_of_triangle[face][c]];
        u += weights[c] * static_cast<double>(uv[0]);
        v += weights[c] * static_cast<double>(uv[1]);
      }
      const auto [across, down] = texture_place(material, u, v);
      largest = std::max(largest, alpha_at(texture, across, down));
    }
  }
  return largest;
}

bool is_visible(const Appearance& appearance, std::size_t face, KnownAlphas& known) {
  const std::uint32_t index = appearance.material_of_triangle[face];
  if (index >= appearance.materials.size()) {
    return true;  // without a material
  }
  const Material& material = appearance.materials[index];
  if (material.alpha == AlphaMode::Opaque) {
    return true;
  }
  const double least = material.alpha == AlphaMode::Mask ? material.alpha_cutoff : kLeastOpacity;
  return material.opacity >= least &&
         (!material.texture ||
          material.opacity * largest_alpha(appearance, material, face, known) >= least);
}

}  // namespace

bool make_visible(Appearance& appearance) {
  const std::size_t faces = appearance.material_of_triangle.size();
  KnownAlphas known(appearance.textures.size());
  for (std::size_t face = 0; face < faces; ++face) {
    if (is_visible(appearance, face, known)) {
      return false;
    }
  }
  for (Material& material : appearance.materials) {
    material.alpha = AlphaMode::Opaque;
  }
  return faces > 0;
}

}  // namespace vantage
