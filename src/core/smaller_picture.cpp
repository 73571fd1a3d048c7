// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/core/vec3.h"

#include "core/parallel.h"
#include "core/srgb.h"

namespace vantage {
namespace {

/// The part of pixel `at` of `count` that it shares with each of the pixels of a picture of `size`.
struct PixelShares {
  int first = 0;
  std::vector<double> shares{};

  PixelShares(int at, int count, int size) {
    const double begin = static_cast<double>(at) * size / count;
    const double end = static_cast<double>(at + 1) * size / count;
    first = static_cast<int>(begin);
    for (int i = first; i < std::min(size, static_cast<int>(std::ceil(end))); ++i) {
      shares.push_back(std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i)));
    }
  }
};

/// The mean light of what a pixel covers, weighted by opacity.
std::array<std::uint8_t, 4> mixed(const Image& image, const PixelShares& across,
                                  const PixelShares& down) {
  Vec3 light = Vec3::Zero();
  double alpha = 0.0;
  double area = 0.0;
  for (std::size_t j = 0; j < down.shares.size(); ++j) {
    for (std::size_t i = 0; i < across.shares.size(); ++i) {
      const std::uint8_t* pixel =
          image.pixel(across.first + static_cast<int>(i), down.first + static_cast<int>(j));
      const double share = down.shares[j] * across.shares[i];
      const double opacity = share * pixel[3] / 255.0;
      area += share;
      alpha += opacity;
      light += opacity * linear_of_srgb({pixel[0], pixel[1], pixel[2]});
    }
  }
  const Rgb8 colour = alpha > 0.0 ? srgb_of_linear(Vec3(light / alpha)) : Rgb8{};
  return {colour[0], colour[1], colour[2],
          static_cast<std::uint8_t>(std::lround(255.0 * alpha / area))};
}

}  // namespace

Image smaller_picture(const Image& image, int width, int height, const RunContext& run) {
  Image result{width, height, {}};
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
  result.rgba.resize(row_bytes * static_cast<std::size_t>(height));
  std::vector<PixelShares> columns;
  for (int x = 0; x < width; ++x) {
    columns.emplace_back(x, width, image.width);
  }
  parallel_for(run, static_cast<std::size_t>(height), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const PixelShares rows(static_cast<int>(y), height, image.height);
      std::uint8_t* pixel = result.rgba.data() + y * row_bytes;
      for (const PixelShares& across : columns) {
        pixel = std::copy_n(mixed(image, across, rows).data(), 4, pixel);
      }
    }
  });
  return result;
}

}  // namespace vantage
