// SPDX-License-Identifier: MIT
#include "core/random.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(Pcg32Stream, GivesTheNumbersOfTheReferenceImplementation) {
  // The demonstration program of the PCG reference implementation, seed 42, stream 54.
  Pcg32 random(42, 54);
  for (const std::uint32_t expected :
       {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U, 0xbfa4784bU, 0xcbed606eU}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Pcg32Stream, DiffersFromItsNeighbour) {
  Pcg32 first(1, 0);
  Pcg32 second(1, 1);
  int equal = 0;
  for (int i = 0; i < 1000; ++i) {
    equal += first.next() == second.next() ? 1 : 0;
  }
  EXPECT_LE(equal, 1);
}

TEST(Pcg32Below, HitsEveryValueAboutEquallyOften) {
  constexpr int kDraws = 60'000;
  Pcg32 random(7);
  std::array<int, 6> count{};
  for (int i = 0; i < kDraws; ++i) {
    ++count.at(random.below(6));
  }
  // Six standard deviations of a binomial with p = 1/6.
  const double tolerance = 6.0 * std::sqrt(kDraws * (1.0 / 6.0) * (5.0 / 6.0));
  for (const int c : count) {
    EXPECT_NEAR(c, kDraws / 6.0, tolerance);
  }
}

TEST(Pcg32Below, OneIsAlwaysZero) {
  Pcg32 random(7);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(random.below(1), 0U);
  }
}

TEST(Pcg32Uniform, StaysInTheHalfOpenUnitIntervalWithMeanOneHalf) {
  constexpr int kDraws = 100'000;
  Pcg32 random(3);
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 6.0 * std::sqrt(1.0 / 12.0 / kDraws));
}

}  // namespace
}  // namespace vantage
