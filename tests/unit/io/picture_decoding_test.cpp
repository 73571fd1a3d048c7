// SPDX-License-Identifier: MIT
#include "io/picture_decoding.h"

#include <cstdint>
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "vantage/io/write.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;

Image two_pixels() {
  return {2, 1, {255, 0, 10, 255, 20, 30, 40, 128}};
}

/// 16 × 8 pixels of (200, 40, 40), made for this test.
std::string red_jpeg() {
  constexpr std::string_view kHex =
      "ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f1320151312"
      "1213271c1e17202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a5152"
      "4fffdb0043010e0e0e131113261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f"
      "4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4fffc000110800080010030122000211010311"
      "01ffc4001500010100000000000000000000000000000005ffc4001410010000000000000000000000000000"
      "0000ffc4001501010100000000000000000000000000000406ffc40014110100000000000000000000000000"
      "000000ffda000c03010002110311003f008c000ae7ffd9";
  std::string bytes;
  for (std::size_t i = 0; i + 1 < kHex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(kHex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

/// A PNG that declares a size and holds nothing.
std::string png_header(const std::string& width, const std::string& height) {
  std::string png = png_bytes(two_pixels());
  return png.replace(16, 4, width).replace(20, 4, height);
}

TEST(DecodePicture, GivesThePixelsOfAPngBack) {
  EXPECT_EQ(decode_picture(png_bytes(two_pixels())).image->rgba, two_pixels().rgba);
}

TEST(DecodePicture, GivesTheUpperBytesOfA16BitPng) {
  const DeepImage deep{1, 1, {0xFFFF, 0x8080, 0, 0xFFFF}};
  const std::optional<Image> image = decode_picture(png_bytes(deep)).image;
  ASSERT_TRUE(image);
  EXPECT_THAT(image->rgba, testing::ElementsAre(255, 128, 0, 255));
}

/// A chunk of a PNG, whose checksum libpng does not need to be right where the chunk may be left out.
std::string png_chunk(const std::string& name, const std::string& content) {
  std::string chunk;
  for (int i = 0; i < 4; ++i) {
    chunk += static_cast<char>(content.size() >> (24 - 8 * i) & 0xFFU);
  }
  chunk += name + content;
  const auto sum =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const unsigned char*>(chunk.data()) + 4,
                                       static_cast<unsigned>(chunk.size() - 4)));
  for (int i = 0; i < 4; ++i) {
    chunk += static_cast<char>(sum >> (24 - 8 * i) & 0xFFU);
  }
  return chunk;
}

// Textures are sRGB (glTF 2.0, 3.9.2): linear light, as 16 bits and gamma 1 once meant, made them pale.
TEST(DecodePicture, TakesNumbersAsTheyAreWhateverThePngSaysOfItsColourSpace) {
  constexpr std::size_t kBehindHeader = 8 + 25;
  const std::string gamma = png_chunk("gAMA", std::string("\x00\x01\x86\xA0", 4));  // 1.0
  std::string shallow = png_bytes(two_pixels());
  EXPECT_EQ(decode_picture(shallow.insert(kBehindHeader, gamma)).image->rgba, two_pixels().rgba);
  std::string deep = png_bytes(DeepImage{1, 1, {0x4040, 0x8080, 0xC0C0, 0xFFFF}});
  if (const std::size_t said = deep.find("sRGB"); said != std::string::npos) {
    deep.erase(said - 4, 13);
  }
  for (const std::string& bytes : {deep, std::string(deep).insert(kBehindHeader, gamma)}) {
    EXPECT_THAT(decode_picture(bytes).image->rgba, testing::ElementsAre(0x40, 0x80, 0xC0, 255));
  }
}

TEST(DecodePicture, ReadsJpegAndItsSize) {
  const std::optional<Image> image = decode_picture(red_jpeg()).image;
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 16);
  EXPECT_EQ(image->height, 8);
  EXPECT_NEAR(image->pixel(5, 5)[0], 200, 4);
  EXPECT_NEAR(image->pixel(5, 5)[1], 40, 4);
  EXPECT_EQ(image->pixel(5, 5)[3], 255);
}

TEST(DecodePicture, HalvesAJpegUntilItsLongerSideIsTheWantedOne) {
  EXPECT_EQ(decode_picture(red_jpeg(), kMostPicturePixels, 4).image->width, 4);
  EXPECT_EQ(decode_picture(red_jpeg(), kMostPicturePixels, 9).image->width, 16);
}

TEST(DecodePicture, ReadsWebpWithItsOpacity) {
  const std::optional<Image> image = decode_picture(webp_bytes(two_pixels())).image;
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pixel(1, 0)[3], 128);
}

TEST(DecodePicture, RefusesAPngThatDeclaresMoreThanTheLimit) {
  // 65 536 × 65 536 would take 16 GB; 16 384 × 8 192 has sides that pass and too many pixels.
  EXPECT_THAT(
      decode_picture(png_header(std::string("\0\1\0\0", 4), std::string("\0\1\0\0", 4))).problem,
      testing::AnyOf(HasSubstr("too large"), HasSubstr("not a sound PNG")));
  const std::string wide = png_bytes(Image{9000, 1, std::vector<std::uint8_t>(36000)});
  EXPECT_THAT(decode_picture(wide, 8999).problem,
              HasSubstr("too large with 9000 × 1 pixels beside the model's other pictures"));
  EXPECT_TRUE(decode_picture(wide, 9000).image);
}

TEST(DecodePicture, RefusesAJpegAndAWebpBeyondTheLimit) {
  EXPECT_THAT(decode_picture(red_jpeg(), 127).problem, HasSubstr("too large"));
  EXPECT_THAT(decode_picture(webp_bytes(two_pixels()), 1).problem, HasSubstr("too large"));
}

TEST(DecodePicture, SaysWhatIsWrongWithBrokenOnes) {
  for (const std::string& whole : {png_bytes(two_pixels()), webp_bytes(two_pixels())}) {
    const DecodedPicture cut = decode_picture(std::string_view(whole).substr(0, 30));
    EXPECT_FALSE(cut.image);
    EXPECT_THAT(cut.problem, HasSubstr("is not a sound"));
  }
  EXPECT_THAT(decode_picture(red_jpeg().substr(0, 40)).problem, HasSubstr("is not a sound JPEG"));
}

TEST(DecodePicture, NamesTheFormatsThatAreRead) {
  EXPECT_THAT(decode_picture("GIF89a").problem, HasSubstr("convert it to one of these"));
  EXPECT_FALSE(decode_picture("").image);
}

}  // namespace
}  // namespace vantage::test
