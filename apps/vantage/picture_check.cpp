// SPDX-License-Identifier: MIT
#include "picture_check.h"

#include <algorithm>
#include <cstddef>

namespace vantage::cli {
namespace {

// Of the pixels: what shows less is overlooked. [ours]
constexpr std::size_t kOneIn = 2000;
constexpr std::size_t kChannels = 4;

template <class Channel>
std::string warning_about(const std::vector<Channel>& rgba) {
  if (rgba.size() < kChannels) {
    return {};
  }
  const auto first = rgba.begin();
  std::size_t shown = 0;
  for (auto pixel = first; pixel != rgba.end(); pixel += kChannels) {
    shown += std::equal(pixel, pixel + kChannels, first) ? 0 : 1;
  }
  const std::size_t pixels = rgba.size() / kChannels;
  if (shown > 0 && kOneIn * shown >= pixels) {
    return {};
  }
  const std::string shows = shown == 0 ? "nothing"
                                       : "the model in " + std::to_string(shown) + " of " +
                                             std::to_string(pixels) + " pixels only";
  return "the picture shows " + shows +
         ": the model is too thin from there, its parts are far apart, or its materials make it "
         "transparent; try a larger --size, --style clay, --front or --focus";
}

}  // namespace

std::string emptiness_warning(const Image& picture) {
  return warning_about(picture.rgba);
}

std::string emptiness_warning(const DeepImage& picture) {
  return warning_about(picture.rgba);
}

}  // namespace vantage::cli
