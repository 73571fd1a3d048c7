// SPDX-License-Identifier: MIT
#include "batch/thumbnail.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <png.h>

namespace vantage::batch {
namespace {

/// Mean over columns [x0, x1) and rows [y0, y1).
std::array<std::uint8_t, 4> mean_of(const Image& image, int x0, int x1, int y0, int y1) {
  std::array<std::uint64_t, 4> sum{};
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::uint8_t* pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += std::uint64_t{pixel[c]} * pixel[3];
      }
      sum[3] += pixel[3];
    }
  }
  std::array<std::uint8_t, 4> mean{};
  const auto count = static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0);
  for (std::size_t c = 0; c < 3 && sum[3] > 0; ++c) {
    mean[c] = static_cast<std::uint8_t>((sum[c] + sum[3] / 2) / sum[3]);
  }
  mean[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
  return mean;
}

}  // namespace

Image thumbnail_of(const Image& image) {
  const int longest = std::max(image.width, image.height);
  if (longest <= kThumbnailSide) {
    return image;
  }
  Image small;
  small.width = std::max(1, image.width * kThumbnailSide / longest);
  small.height = std::max(1, image.height * kThumbnailSide / longest);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const auto mean =
          mean_of(image, x * image.width / small.width, (x + 1) * image.width / small.width,
                  y * image.height / small.height, (y + 1) * image.height / small.height);
      small.rgba.insert(small.rgba.end(), mean.begin(), mean.end());
    }
  }
  return small;
}

std::optional<Image> parse_png(std::string_view bytes, int longest_side) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return std::nullopt;
  }
  png.format = PNG_FORMAT_RGBA;
  const auto most = static_cast<png_uint_32>(longest_side);
  if (png.width > most || png.height > most) {
    png_image_free(&png);
    return std::nullopt;
  }
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.rgba.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    return std::nullopt;
  }
  return image;
}

}  // namespace vantage::batch
