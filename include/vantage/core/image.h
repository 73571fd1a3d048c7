// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/run_context.h"

namespace vantage {

/// Red, green, blue as sRGB bytes.
using Rgb8 = std::array<std::uint8_t, 3>;

/// A picture: row-major, origin top left, sRGB with straight (not premultiplied) alpha.
struct Image {
  int width = 0;                     ///< px
  int height = 0;                    ///< px
  std::vector<std::uint8_t> rgba{};  ///< 4 · width · height bytes.

  /// First of the four bytes of pixel (x, y).
  [[nodiscard]] const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
  }
};

/// The same in 16 bit: what is left when a picture is brightened or graded.
struct DeepImage {
  int width = 0;                      ///< px
  int height = 0;                     ///< px
  std::vector<std::uint16_t> rgba{};  ///< 4 · width · height values.
};

/// A smaller copy: means over areas, of light times opacity. \pre 0 < width ≤ that of the image, and
/// the same for the height. \throw Cancelled
Image smaller_picture(const Image& image, int width, int height, const RunContext& run = {});

}  // namespace vantage
