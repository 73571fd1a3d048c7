// SPDX-License-Identifier: MIT
#include "render/texture_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/srgb.h"

namespace vantage {
namespace {

constexpr float kFull = 65535.0F;
/// Rounding of sums of texels: far less than a step of 8 bits.
constexpr float kTexelRounding = 1e-5F;

/// Linear light of each sRGB byte.
const std::array<float, 256>& linear_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t byte = 0; byte < values.size(); ++byte) {
      values[byte] = static_cast<float>(linear_of_srgb(static_cast<std::uint8_t>(byte)));
    }
    return values;
  }();
  return table;
}

/// Texel `i` of a row or column of `size` after wrapping.
int wrapped(int i, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) {
    return std::clamp(i, 0, size - 1);
  }
  const int period = wrap == TextureWrap::Mirror ? 2 * size : size;
  const int folded = ((i % period) + period) % period;
  return folded < size ? folded : period - 1 - folded;
}

/// A coordinate brought to where integers hold it: whole repetitions look alike.
float near_origin(float u, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) {
    return std::clamp(u, -1.0F, 2.0F);
  }
  return u - 2.0F * std::floor(0.5F * u);
}

}  // namespace

TexturePyramid::TexturePyramid(const Texture& texture, std::optional<float> cutoff)
    : texture_(&texture), cutoff_(cutoff) {
  while (halves_.empty() ? std::max(width(), height()) > 1
                         : std::max(halves_.back().width, halves_.back().height) > 1) {
    add_half();
  }
}

std::array<std::uint16_t, 4> TexturePyramid::mean(std::size_t level, int x0, int x1, int y0,
                                                  int y1) const {
  Premultiplied sum{};
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Premultiplied texel = level == 0 ? cut(fetch(0, x, y)) : fetch(level, x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        sum[c] += texel[c];
      }
    }
  }
  const float share = kFull / static_cast<float>((x1 - x0) * (y1 - y0));
  std::array<std::uint16_t, 4> rounded{};
  for (std::size_t c = 0; c < 4; ++c) {
    rounded[c] = static_cast<std::uint16_t>(std::min(kFull, share * sum[c] + 0.5F));
  }
  return rounded;
}

void TexturePyramid::add_half() {
  const std::size_t above = halves_.size();
  const int wide = above == 0 ? width() : halves_.back().width;
  const int high = above == 0 ? height() : halves_.back().height;
  Level half{std::max(1, wide / 2), std::max(1, high / 2), {}};
  half.texels.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      // An odd last row or column is shared by what is beside it.
      half.texels.push_back(mean(above, 2 * x, x + 1 == half.width ? wide : 2 * x + 2, 2 * y,
                                 y + 1 == half.height ? high : 2 * y + 2));
    }
  }
  halves_.push_back(std::move(half));
}

TexturePyramid::Premultiplied TexturePyramid::cut(Premultiplied seen) const {
  if (!cutoff_ || is_opaque()) {
    return seen;
  }
  if (seen[3] < *cutoff_ - kTexelRounding) {
    return {};
  }
  // A cutoff of next to nothing lets pass what has no colour: it stays black.
  const float alpha = std::max(seen[3], kTexelRounding);
  return {seen[0] / alpha, seen[1] / alpha, seen[2] / alpha, 1.0F};
}

TexturePyramid::Premultiplied TexturePyramid::fetch(std::size_t level, int x, int y) const {
  if (level == 0) {
    const std::uint8_t* pixel = texture_->image.pixel(x, y);
    const std::array<float, 256>& table = linear_table();
    const float alpha = is_opaque() ? 1.0F : static_cast<float>(pixel[3]) / 255.0F;
    return {alpha * table[pixel[0]], alpha * table[pixel[1]], alpha * table[pixel[2]], alpha};
  }
  const Level& half = halves_[level - 1];
  const auto& texel =
      half.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(half.width) +
                  static_cast<std::size_t>(x)];
  Premultiplied result{};
  for (std::size_t c = 0; c < 4; ++c) {
    result[c] = static_cast<float>(texel[c]) / kFull;
  }
  return result;
}

TexturePyramid::Premultiplied TexturePyramid::bilinear(std::size_t level, float u, float v,
                                                       bool nearest) const {
  const int wide = level == 0 ? width() : halves_[level - 1].width;
  const int high = level == 0 ? height() : halves_[level - 1].height;
  const float across = u * static_cast<float>(wide) - 0.5F;
  const float along = v * static_cast<float>(high) - 0.5F;
  float x = std::floor(across);
  float y = std::floor(along);
  float right = across - x;
  float below = along - y;
  if (nearest) {
    right = right < 0.5F ? 0.0F : 1.0F;
    below = below < 0.5F ? 0.0F : 1.0F;
  }
  const std::array<int, 2> columns{wrapped(static_cast<int>(x), wide, texture_->wrap_u),
                                   wrapped(static_cast<int>(x) + 1, wide, texture_->wrap_u)};
  const std::array<int, 2> rows{wrapped(static_cast<int>(y), high, texture_->wrap_v),
                                wrapped(static_cast<int>(y) + 1, high, texture_->wrap_v)};
  Premultiplied sum{};
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 2; ++i) {
      const float weight = (i == 0 ? 1.0F - right : right) * (j == 0 ? 1.0F - below : below);
      if (weight > 0.0F) {
        const Premultiplied texel = fetch(level, columns[i], rows[j]);
        for (std::size_t c = 0; c < 4; ++c) {
          sum[c] += weight * texel[c];
        }
      }
    }
  }
  return sum;
}

Texel TexturePyramid::at(float u, float v, float level) const {
  u = near_origin(u, texture_->wrap_u);
  v = near_origin(v, texture_->wrap_v);
  const float last = static_cast<float>(halves_.size());
  const float height = level > 0.0F ? std::min(level, last) : 0.0F;  // not a number: the finest
  const auto low = static_cast<std::size_t>(height);
  const float share = height - static_cast<float>(low);
  Premultiplied seen = bilinear(low, u, v, texture_->nearest && height == 0.0F);
  seen = low == 0 ? cut(seen) : seen;
  if (share > 0.0F) {
    const Premultiplied coarser = bilinear(low + 1, u, v, false);
    for (std::size_t c = 0; c < 4; ++c) {
      seen[c] += share * (coarser[c] - seen[c]);
    }
  }
  Texel texel;
  texel.opacity = seen[3];
  if (seen[3] > 0.0F) {
    texel.colour = Vec3f(seen[0], seen[1], seen[2]) / seen[3];
  }
  return texel;
}

}  // namespace vantage
