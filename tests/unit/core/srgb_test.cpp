// SPDX-License-Identifier: MIT
#include "core/srgb.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(Srgb, EveryByteSurvivesTheWayToLinearLightAndBack) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(srgb_of_linear(linear_of_srgb(static_cast<std::uint8_t>(byte))), byte);
  }
}

TEST(Srgb, HalfTheLightIsByte188) {
  // 255 (1.055 · 0.5^(1/2.4) − 0.055) = 187.5…
  EXPECT_EQ(srgb_of_linear(0.5), std::lround(255.0 * (1.055 * std::pow(0.5, 1.0 / 2.4) - 0.055)));
}

TEST(Srgb, ValuesOutsideAreClamped) {
  EXPECT_EQ(srgb_of_linear(-0.25), 0);
  EXPECT_EQ(srgb_of_linear(7.0), 255);
}

}  // namespace
}  // namespace vantage
