// SPDX-License-Identifier: MIT
#include "batch/thumbnail.h"

#include <algorithm>

#include <png.h>

namespace vantage::batch {

Image thumbnail_of(const Image& image) {
  const int longest = std::max(image.width, image.height);
  if (longest <= kThumbnailSide) {
    return image;
  }
  const auto shortened = [&](int side) { return std::max(1, side * kThumbnailSide / longest); };
  return smaller_picture(image, shortened(image.width), shortened(image.height));
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
