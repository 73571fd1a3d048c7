// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// Light and opacity of a place on a texture.
struct Texel {
  Vec3f colour = Vec3f::Zero();  ///< Linear, in [0, 1].
  float opacity = 1.0F;          ///< In [0, 1].
};

/// A texture at full size, a half, a quarter, … in linear light, so that a sample that covers many
/// texels shows their mean: Williams, "Pyramidal Parametrics", SIGGRAPH 1983, doi:10.1145/800059.801126.
/// Colours are weighted by opacity on the way: what cannot be seen has no say. Of a texture with holes
/// the larger texels hold how much of them is solid: a fence does not vanish in the distance.
class TexturePyramid {
 public:
  /// \param texture must outlive this; at least one pixel. \param cutoff what is less opaque is a hole,
  /// all else is solid; at 0 the texture's opacity means nothing: files hide other things in it, and
  /// colours where it is 0. Without it what is behind shines through.
  explicit TexturePyramid(const Texture& texture, std::optional<float> cutoff = {});

  /// What is seen at (u, v) by a sample that covers 2^level texels across, mixed between texels and
  /// between sizes; level ≤ 0 is a single texel or less.
  [[nodiscard]] Texel at(float u, float v, float level) const;

  [[nodiscard]] int width() const { return texture_->image.width; }

  [[nodiscard]] int height() const { return texture_->image.height; }

 private:
  /// 16 bit, linear, colours times opacity.
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::array<std::uint16_t, 4>> texels{};
  };

  using Premultiplied = std::array<float, 4>;

  [[nodiscard]] bool is_opaque() const { return cutoff_ && *cutoff_ <= 0.0F; }

  /// A hole or solid, of a place of the texture itself, if it has holes.
  [[nodiscard]] Premultiplied cut(Premultiplied seen) const;
  [[nodiscard]] Premultiplied fetch(std::size_t level, int x, int y) const;
  [[nodiscard]] Premultiplied bilinear(std::size_t level, float u, float v, bool nearest) const;
  /// Mean over columns [x0, x1) and rows [y0, y1) of a level.
  [[nodiscard]] std::array<std::uint16_t, 4> mean(std::size_t level, int x0, int x1, int y0,
                                                  int y1) const;
  void add_half();

  const Texture* texture_;
  std::optional<float> cutoff_;
  std::vector<Level> halves_{};  ///< Level 1, 2, …; level 0 is the image.
};

}  // namespace vantage
