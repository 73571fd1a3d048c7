// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/render/render.h"

#include "core/srgb.h"

namespace vantage {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One byte of one channel may round the other way: the largest step of a byte in luminance.
constexpr double kByteRounding = 0.008;

/// Relative luminance (Rec. 709).
double luminance(const Rgb8& colour) {
  return linear_of_srgb(colour).dot(Vec3(0.2126, 0.7152, 0.0722));
}

TEST(CoolWarm, LowIsBlueAndHighIsRed) {
  const Rgb8 low = cool_warm(0.0);
  const Rgb8 high = cool_warm(1.0);
  EXPECT_GT(low[2], 2 * std::max(low[0], low[1]));
  EXPECT_GT(high[0], 2 * std::max(high[1], high[2]));
}

TEST(CoolWarm, TheMiddleIsGreen) {
  const Rgb8 middle = cool_warm(0.5);
  EXPECT_GT(middle[1], std::max(middle[0], middle[2]));
}

TEST(CoolWarm, ValuesOutsideTakeTheColourOfTheirEnd) {
  EXPECT_EQ(cool_warm(-3.0), cool_warm(0.0));
  EXPECT_EQ(cool_warm(kInfinity), cool_warm(1.0));
}

TEST(CoolWarm, NanIsGrey) {
  const Rgb8 colour = cool_warm(kNaN);
  EXPECT_EQ(colour[0], colour[1]);
  EXPECT_EQ(colour[1], colour[2]);
}

TEST(CoolWarm, HasNoVisibleStepsOverAThousandValues) {
  for (int i = 0; i < 1000; ++i) {
    const Rgb8 a = cool_warm(i / 1000.0);
    const Rgb8 b = cool_warm((i + 1) / 1000.0);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LE(std::abs(a[c] - b[c]), 3) << "channel " << c << " at " << i;
    }
  }
}

TEST(CoolWarm, BrightensFromBlueToYellowAndDarkensToRed) {
  for (int i = 0; i < 100; ++i) {
    const double step = luminance(cool_warm((i + 1) / 100.0)) - luminance(cool_warm(i / 100.0));
    if (i < 60) {
      EXPECT_GT(step, -kByteRounding) << i;
    } else if (i >= 76) {
      EXPECT_LT(step, kByteRounding) << i;
    }
  }
}

TEST(ColourMap, SpansFromTheLeastToTheLargestValue) {
  const std::vector<double> values{-2.0, 0.0, 2.0};
  EXPECT_EQ(colour_map(values),
            (std::vector<Rgb8>{cool_warm(0.0), cool_warm(0.5), cool_warm(1.0)}));
}

TEST(ColourMap, OfEqualValuesIsAllCool) {
  const std::vector<double> values{7.0, 7.0};
  EXPECT_EQ(colour_map(values), (std::vector<Rgb8>{cool_warm(0.0), cool_warm(0.0)}));
}

TEST(ColourMap, LeavesNonFiniteValuesOutOfTheScale) {
  const std::vector<double> values{kNaN, 1.0, 3.0, kInfinity, -kInfinity};
  EXPECT_EQ(colour_map(values), (std::vector<Rgb8>{cool_warm(kNaN), cool_warm(0.0), cool_warm(1.0),
                                                   cool_warm(1.0), cool_warm(0.0)}));
}

TEST(ColourMap, ScalesTheWholeRangeOfDouble) {
  const double most = std::numeric_limits<double>::max();
  const std::vector<double> values{-most, most};
  EXPECT_EQ(colour_map(values), (std::vector<Rgb8>{cool_warm(0.0), cool_warm(1.0)}));
}

TEST(ColourMap, OfNothingIsNothing) {
  EXPECT_TRUE(colour_map({}).empty());
}

}  // namespace
}  // namespace vantage
