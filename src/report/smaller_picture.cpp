// SPDX-License-Identifier: MIT
#include "report/smaller_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"

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

}  // namespace

Image smaller_picture(const Image& image, int width, int height) {
  Image result{width, height, {}};
  result.rgba.reserve(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<PixelShares> columns;
  for (int x = 0; x < width; ++x) {
    columns.emplace_back(x, width, image.width);
  }
  for (int y = 0; y < height; ++y) {
    const PixelShares rows(y, height, image.height);
    for (const PixelShares& across : columns) {
      Vec3 light = Vec3::Zero();
      double alpha = 0.0;
      double area = 0.0;
      for (std::size_t j = 0; j < rows.shares.size(); ++j) {
        for (std::size_t i = 0; i < across.shares.size(); ++i) {
          const std::uint8_t* pixel =
              image.pixel(across.first + static_cast<int>(i), rows.first + static_cast<int>(j));
          const double share = rows.shares[j] * across.shares[i];
          const double opacity = share * pixel[3] / 255.0;
          area += share;
          alpha += opacity;
          light += opacity * linear_of_srgb({pixel[0], pixel[1], pixel[2]});
        }
      }
      const Rgb8 colour = alpha > 0.0 ? srgb_of_linear(Vec3(light / alpha)) : Rgb8{};
      result.rgba.insert(result.rgba.end(), colour.begin(), colour.end());
      result.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0 * alpha / area)));
    }
  }
  return result;
}

}  // namespace vantage
