// SPDX-License-Identifier: MIT
#include "batch/thumbnail.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "vantage/io/write.h"

namespace vantage::batch {
namespace {

Image filled(int width, int height, std::array<std::uint8_t, 4> colour) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
  }
  return image;
}

TEST(Thumbnail, KeepsTheShapeAndAnEvenColour) {
  const Image small = thumbnail_of(filled(800, 600, {10, 200, 30, 128}));
  EXPECT_EQ(small.width, 160);
  EXPECT_EQ(small.height, 120);
  EXPECT_EQ(small.rgba, filled(160, 120, {10, 200, 30, 128}).rgba);
}

TEST(Thumbnail, TransparentPixelsDoNotColourTheirNeighbours) {
  Image image = filled(320, 320, {255, 0, 0, 255});
  for (std::size_t i = 0; i < image.rgba.size(); i += 8) {  // every second column: green, unseen
    image.rgba[i] = 0;
    image.rgba[i + 1] = 255;
    image.rgba[i + 3] = 0;
  }
  const Image small = thumbnail_of(image);
  // half of each pixel is seen: (0 + 255) / 2 rounded up
  EXPECT_EQ(small.rgba, filled(160, 160, {255, 0, 0, 128}).rgba);
}

TEST(Thumbnail, IsAsLightAsThePicture) {
  Image image = filled(320, 320, {255, 255, 255, 255});
  for (std::size_t i = 0; i < image.rgba.size(); i += 8) {  // every second column: black
    image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = 0;
  }
  // 188 is half the light of 255 (IEC 61966-2-1); 128 would be a fifth.
  EXPECT_EQ(thumbnail_of(image).rgba, filled(160, 160, {188, 188, 188, 255}).rgba);
}

TEST(Thumbnail, APngReadsBackUnlessItIsTooLargeOrTorn) {
  const Image image = filled(20, 10, {1, 2, 3, 255});
  const std::string bytes = png_bytes(image);
  const auto read = parse_png(bytes, 20);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rgba, image.rgba);
  EXPECT_FALSE(parse_png(bytes, 19));
  EXPECT_FALSE(parse_png(bytes.substr(0, bytes.size() / 2), 20));
  EXPECT_FALSE(parse_png("", 20));
}

}  // namespace
}  // namespace vantage::batch
