// SPDX-License-Identifier: MIT
#include "report/line_drawing.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/lettering.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;

constexpr Rgb8 kBlack{0, 0, 0};

/// Area that is inked, px.
double ink(const LineDrawing& drawing) {
  const Image image = drawing.image();
  double sum = 0.0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    sum += (255 - image.rgba[i]) / 255.0;
  }
  return sum;
}

TEST(LineDrawing, ADotHasTheAreaOfItsDisc) {
  LineDrawing drawing(40, 40);
  drawing.dot({20.3, 19.6}, 9.0, kBlack);
  EXPECT_NEAR(ink(drawing), 81.0 * std::numbers::pi, 1.5);
}

TEST(LineDrawing, ALineHasItsLengthTimesItsWidthAndRoundEnds) {
  LineDrawing drawing(60, 60);
  drawing.line({{10, 10}, {40, 50}}, 4.0, kBlack);
  EXPECT_NEAR(ink(drawing), 50.0 * 4.0 + 4.0 * std::numbers::pi, 2.0);
}

TEST(LineDrawing, AnAreaIsFilledWhicheverWayRoundItIsGiven) {
  for (const std::vector<PixelPoint>& corners :
       {std::vector<PixelPoint>{{5, 5}, {25, 5}, {5, 35}},
        std::vector<PixelPoint>{{5, 5}, {5, 35}, {25, 5}}}) {
    LineDrawing drawing(40, 40);
    drawing.fill(corners, kBlack);
    EXPECT_NEAR(ink(drawing), 300.0, 5.0);
  }
}

TEST(LineDrawing, TheLaterShapeLiesOver) {
  LineDrawing drawing(20, 20);
  drawing.dot({10, 10}, 8.0, kBlack);
  drawing.dot({10, 10}, 4.0, {255, 0, 0});
  EXPECT_EQ(drawing.image().pixel(10, 10)[0], 255);
  EXPECT_EQ(drawing.image().pixel(10, 4)[0], 0);
}

TEST(LineDrawing, AsSvgHasTheSameShapes) {
  LineDrawing drawing(20, 10);
  drawing.line({{1, 2}, {3.456, 4}}, 1.5, {255, 128, 0});
  drawing.fill({{0, 0}, {1, 0}, {0, 1}}, kBlack);
  EXPECT_THAT(drawing.svg(), HasSubstr("viewBox=\"0 0 20 10\""));
  EXPECT_THAT(drawing.svg(),
              HasSubstr("d=\"M1 2L3.46 4\" fill=\"none\" stroke=\"#ff8000\" stroke-width=\"1.5\""));
  EXPECT_THAT(drawing.svg(), HasSubstr("d=\"M0 0L1 0L0 1Z\" fill=\"#000000\""));
}

TEST(Lettering, EveryPrintableLetterHasStrokesWithinItsBox) {
  for (char c = '!'; c <= '~'; ++c) {
    const std::string_view text(&c, 1);
    const std::vector<Stroke> strokes = letter_strokes(text);
    EXPECT_FALSE(strokes.empty()) << c;
    for (const Stroke& stroke : strokes) {
      EXPECT_GE(stroke.size(), 2U) << c;
      for (const auto& [x, y] : stroke) {
        EXPECT_GE(x, -1e-12) << c;
        EXPECT_LT(x, lettering_width(text)) << c;
        EXPECT_GE(y, -0.34) << c;
        EXPECT_LE(y, 1.0 + 1e-12) << c;
      }
    }
  }
}

TEST(Lettering, IsAsWideAsItsLettersTogether) {
  EXPECT_NEAR(lettering_width("ab"), lettering_width("a") + lettering_width("b"), 1e-12);
  EXPECT_TRUE(letter_strokes(" \n").empty());
}

}  // namespace
}  // namespace vantage::test
