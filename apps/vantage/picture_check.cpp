// SPDX-License-Identifier: MIT
#include "picture_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace vantage::cli {
namespace {

// Of the picture: what covers less is overlooked. [ours]
constexpr double kLeastCover = 1.0 / 500.0;
constexpr std::size_t kChannels = 4;

template <class Picture>
std::string warning_about(const Picture& picture) {
  const std::size_t width = kChannels * static_cast<std::size_t>(picture.width);
  if (width == 0 || picture.rgba.size() < width) {
    return {};
  }
  const double opaque = std::numeric_limits<typename decltype(picture.rgba)::value_type>::max();
  std::size_t shown = 0;
  double cover = 0.0;
  for (auto row = picture.rgba.begin(); row != picture.rgba.end();
       row += static_cast<std::ptrdiff_t>(width)) {
    for (std::size_t at = 0; at < width; at += kChannels) {
      const auto pixel = row + static_cast<std::ptrdiff_t>(at);
      if (!std::equal(pixel, pixel + kChannels, row)) {
        const double alpha = std::abs(static_cast<double>(pixel[3]) - static_cast<double>(row[3]));
        ++shown;
        cover += alpha > 0.0 ? alpha / opaque : 1.0;
      }
    }
  }
  const std::size_t pixels = picture.rgba.size() / kChannels;
  if (cover >= kLeastCover * static_cast<double>(pixels)) {
    return {};
  }
  const std::string shows = shown == 0
                                ? "nothing"
                                : "hardly anything: the model is in " + std::to_string(shown) +
                                      " of " + std::to_string(pixels) + " pixels";
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
