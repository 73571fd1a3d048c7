// SPDX-License-Identifier: MIT
#include "picture_check.h"

#include <algorithm>
#include <cstddef>

namespace vantage::cli {
namespace {

// Of the pixels: what shows less is overlooked. [ours]
constexpr std::size_t kOneIn = 2000;
constexpr std::size_t kChannels = 4;

template <class Picture>
std::string warning_about(const Picture& picture) {
  const std::size_t width = kChannels * static_cast<std::size_t>(picture.width);
  if (width == 0 || picture.rgba.size() < width) {
    return {};
  }
  std::size_t shown = 0;
  for (auto row = picture.rgba.begin(); row != picture.rgba.end();
       row += static_cast<std::ptrdiff_t>(width)) {
    for (std::size_t at = 0; at < width; at += kChannels) {
      const auto pixel = row + static_cast<std::ptrdiff_t>(at);
      shown += std::equal(pixel, pixel + kChannels, row) ? 0 : 1;
    }
  }
  const std::size_t pixels = picture.rgba.size() / kChannels;
  if (shown > 0 && kOneIn * shown >= pixels) {
    return {};
  }
  const std::string shows = shown == 0 ? "nothing"
                                       : "the model in " + std::to_string(shown) + " of " +
                                             std::to_string(pixels) + " pixels only";
  return "the picture shows " + shows +
         ": the model is too thin from there, its parts are far apart, its materials make it "
         "transparent, or a given camera looks elsewhere; try a larger --size, --style clay, "
         "--front "
         "or --focus";
}

}  // namespace

std::string emptiness_warning(const Image& picture) {
  return warning_about(picture);
}

std::string emptiness_warning(const DeepImage& picture) {
  return warning_about(picture);
}

}  // namespace vantage::cli
