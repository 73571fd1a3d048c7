// SPDX-License-Identifier: MIT
#include "core/shannon.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(Logarithm, OfAPowerOfTwoIsItsExponent) {
  for (const int exponent : {-1022, -300, -1, 0, 1, 52, 1023}) {
    EXPECT_EQ(log_2(std::ldexp(1.0, exponent)), exponent);
  }
}

TEST(Logarithm, IsRightToTheLastDigits) {
  // Three numbers in each of the table's cells and at their borders, of several sizes.
  for (const double size : {1e-300, 1e-9, 0.5, 1.0, 3.0, 1e12, 1e300}) {
    for (int i = 0; i < 3 * 128 + 1; ++i) {
      const double x = size * (1.0 + i / (3.0 * 128.0));
      const double expected = std::log2(x);
      EXPECT_NEAR(log_2(x), expected, 5e-16 * std::max(1.0, std::abs(expected))) << x;
    }
  }
}

TEST(Logarithm, GrowsAcrossTheBordersOfItsTable) {
  for (int i = 0; i <= 128; ++i) {
    const double border = 1.0 + i / 128.0;
    EXPECT_LT(log_2(border * (1.0 - 1e-14)), log_2(border * (1.0 + 1e-14)));
  }
}

TEST(HistogramEntropy, OfEvenBinsIsTheLogarithmOfTheirNumber) {
  EXPECT_NEAR(histogram_entropy(std::array{0.7, 0.7, 0.7, 0.7, 0.0}), 2.0, 1e-15);
  EXPECT_EQ(histogram_entropy(std::array{0.0, 4.0}), 0.0);
  EXPECT_EQ(histogram_entropy(std::array{0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace vantage
