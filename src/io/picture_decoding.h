// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "vantage/core/image.h"

/// \file
/// Pictures that models carry: PNG, JPEG and WebP, told apart by their first bytes.

namespace vantage {

/// Largest side of a picture that is read, px. [ours]
inline constexpr int kLargestPictureSide = 16384;
/// Most pixels of a picture that is read: 8192 × 8192. A PNG of so many takes 65 KB on disk if it is
/// empty, and 256 MB in memory, so that files may not decide this themselves. [ours]
inline constexpr std::size_t kMostPicturePixels = std::size_t{1} << 26U;

/// A picture, or why there is none.
struct DecodedPicture {
  std::optional<Image> image{};
  std::string problem{};   ///< Continues "the picture …"; empty if there is an image.
  std::size_t pixels = 0;  ///< That were decoded, or may have been before the problem was met.
};

/// Reads a picture. Nothing is allocated before its declared size is within the limits and
/// `most_pixels`. Does not throw but for want of memory.
/// \param wanted_side a JPEG of more than twice this on its longer side is decoded at a half, a
/// quarter or an eighth, not below it; 0: always whole.
DecodedPicture decode_picture(std::string_view bytes, std::size_t most_pixels = kMostPicturePixels,
                              int wanted_side = 0);

/// The parts of decode_picture().
DecodedPicture decode_png(std::string_view bytes, std::size_t most_pixels);
DecodedPicture decode_jpeg(std::string_view bytes, std::size_t most_pixels, int wanted_side);
DecodedPicture decode_webp(std::string_view bytes, std::size_t most_pixels);

/// What is wrong with a size, empty if nothing is.
std::string picture_size_problem(std::size_t width, std::size_t height, std::size_t most_pixels);

}  // namespace vantage
