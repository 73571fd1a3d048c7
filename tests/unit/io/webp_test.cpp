// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <webp/decode.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

namespace vantage {
namespace {

/// A soft disc of one colour, shaded from left to right.
Image disc(int side) {
  Image image{side, side, {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double away = std::hypot(x - side / 2.0, y - side / 2.0) - side / 3.0;
      const auto alpha = static_cast<std::uint8_t>(std::clamp(128.0 - 100.0 * away, 0.0, 255.0));
      const auto grey = static_cast<std::uint8_t>(100 + 100 * x / side);
      for (const std::uint8_t byte : {grey, grey, static_cast<std::uint8_t>(grey / 2), alpha}) {
        image.rgba.push_back(byte);
      }
    }
  }
  return image;
}

std::vector<std::uint8_t> decoded(const std::string& bytes, int& width, int& height) {
  std::uint8_t* rgba = WebPDecodeRGBA(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                      bytes.size(), &width, &height);
  std::vector<std::uint8_t> copy;
  if (rgba != nullptr) {
    copy.assign(rgba, rgba + std::size_t{4} * static_cast<std::size_t>(width * height));
  }
  WebPFree(rgba);
  return copy;
}

TEST(Webp, KeepsAlphaExactlyAndColoursNearly) {
  const Image image = disc(64);
  int width = 0;
  int height = 0;
  const std::vector<std::uint8_t> back = decoded(webp_bytes(image), width, height);
  ASSERT_EQ(back.size(), image.rgba.size());
  EXPECT_EQ(width, 64);
  EXPECT_EQ(height, 64);
  double squares = 0.0;
  int opaque = 0;
  for (std::size_t i = 0; i < back.size(); i += 4) {
    ASSERT_EQ(back[i + 3], image.rgba[i + 3]);
    if (back[i + 3] == 255) {
      squares += std::pow(back[i] - image.rgba[i], 2.0);
      ++opaque;
    }
  }
  EXPECT_LT(std::sqrt(squares / opaque), 2.0);  // of 255: not to be seen
}

TEST(Webp, GivesTheSameBytesAgain) {
  EXPECT_EQ(webp_bytes(disc(48)), webp_bytes(disc(48)));
}

TEST(Webp, RefusesPicturesItCannotHold) {
  EXPECT_THROW(webp_bytes(Image{}), InvalidInput);
  EXPECT_THROW(webp_bytes(Image{16384, 1, std::vector<std::uint8_t>(4 * 16384)}), InvalidInput);
}

}  // namespace
}  // namespace vantage
