// SPDX-License-Identifier: MIT
#include "view/turning.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

/// The angle of (cosine, sine) as angles_of() gives it among `count` others.
double angle_of(double sine, double cosine, std::size_t count = 1) {
  std::vector<double> angles(count);
  angles_of(std::vector<double>(count, sine), std::vector<double>(count, cosine), angles);
  return angles.back();
}

TEST(Angles, AreThoseOfTheDirectionsAllAround) {
  constexpr int kDirections = 1001;
  std::vector<double> sine;
  std::vector<double> cosine;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = (i - 500) * (std::numbers::pi / 501.0);
    const double length = std::pow(10.0, i % 13 - 6);
    sine.push_back(length * std::sin(angle));
    cosine.push_back(length * std::cos(angle));
  }
  std::vector<double> angles(kDirections);
  angles_of(sine, cosine, angles);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    EXPECT_NEAR(angles[i], std::atan2(sine[i], cosine[i]), 1e-15) << i;
  }
}

TEST(Angles, OfTheAxesAreExact) {
  EXPECT_EQ(angle_of(0.0, 3.0), 0.0);
  EXPECT_EQ(angle_of(2.0, 0.0), std::numbers::pi / 2);
  EXPECT_EQ(angle_of(-2.0, 0.0), -std::numbers::pi / 2);
  EXPECT_EQ(angle_of(0.0, -1.0), std::numbers::pi);
}

TEST(Angles, KeepTheDigitsOfTinyOnes) {
  EXPECT_NEAR(angle_of(1e-200, 1.0), 1e-200, 1e-215);
  EXPECT_NEAR(angle_of(-3e-9, 1.0), -3e-9, 1e-23);
}

TEST(Angles, OfNothingIsZero) {
  EXPECT_EQ(angle_of(0.0, 0.0), 0.0);
}

TEST(Angles, AreTheSameWhateverStandsBesideThem) {
  for (const std::size_t count : {2U, 3U, 4U, 5U, 8U}) {
    EXPECT_EQ(angle_of(0.3, -0.7, count), angle_of(0.3, -0.7));
  }
}

}  // namespace
}  // namespace vantage
