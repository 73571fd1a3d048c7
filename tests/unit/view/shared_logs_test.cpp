// SPDX-License-Identifier: MIT
#include "view/shared_logs.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vantage {
namespace {

/// Every `step`-th place of `places`, with areas of very different sizes.
std::vector<FaceArea> areas_at(std::uint32_t places, std::uint32_t step, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<FaceArea> list;
  for (std::uint32_t place = 0; place < places; place += step) {
    list.push_back({place, static_cast<float>(std::exp(20.0 * random.uniform() - 15.0))});
  }
  return list;
}

double x_log_x(double x) {
  return x > 0.0 ? x * std::log2(x) : 0.0;
}

TEST(SharedLogs, AddUpLogarithms) {
  // As many entries as fill lanes, and one to three more.
  for (const std::uint32_t places : {0U, 1U, 2U, 3U, 4U, 101U}) {
    double expected = 0.0;
    double size = 0.0;
    for (const FaceArea& a : areas_at(places, 1, 3)) {
      expected += x_log_x(a.area);
      size += std::abs(x_log_x(a.area));
    }
    EXPECT_NEAR(sum_of_logs(areas_at(places, 1, 3)), expected, 1e-14 * size);
  }
}

TEST(SharedLogs, AreExactForPowersOfTwo) {
  EXPECT_EQ(sum_of_logs(std::vector<FaceArea>{{0, 0.25F}, {1, 8.0F}, {2, 1.0F}}), -0.5 + 24.0);
}

TEST(SharedLogs, OfAScaledListAreThoseOfItsScaledAreas) {
  constexpr double kScale = 0.37;
  for (const std::uint32_t places : {1U, 2U, 3U, 4U, 101U}) {  // full lanes, and others
    const std::vector<FaceArea> list = areas_at(places, 1, 8);
    std::vector<FaceArea> scaled;
    for (const FaceArea& entry : list) {
      scaled.push_back({entry.face, static_cast<float>(kScale * entry.area)});
    }
    LaidOutAreas laid_out(places);
    const std::vector<FaceArea> other = areas_at(places, 2, 9);
    laid_out.put(other);
    EXPECT_EQ(laid_out.logs_with(list, kScale), laid_out.logs_with(scaled)) << places;
    EXPECT_NE(laid_out.logs_with(list, kScale), laid_out.logs_with(list)) << places;
  }
}

TEST(SharedLogs, OfTwoListsAreTheirDefinition) {
  const std::vector<FaceArea> a = areas_at(300, 2, 5);
  const std::vector<FaceArea> b = areas_at(300, 3, 6);
  std::vector<double> of_a(300, 0.0);
  for (const FaceArea& entry : a) {
    of_a[entry.face] = entry.area;
  }
  double expected = 0.0;
  double size = 0.0;
  for (const FaceArea& entry : b) {
    const double own = of_a[entry.face];
    expected += x_log_x(own + entry.area) - x_log_x(own);
    size += std::abs(x_log_x(own + entry.area)) + std::abs(x_log_x(own));
  }
  LaidOutAreas laid_out(300);
  laid_out.put(a);
  EXPECT_NEAR(laid_out.logs_with(b), expected, 1e-14 * size);
}

TEST(SharedLogs, ForgetTheListBefore) {
  const std::vector<FaceArea> b = areas_at(300, 3, 6);
  const std::vector<FaceArea> a = areas_at(300, 2, 5);
  const std::vector<FaceArea> none;
  LaidOutAreas laid_out(300);
  laid_out.put(a);
  laid_out.put(none);
  EXPECT_EQ(laid_out.logs_with(b), sum_of_logs(b));
}

}  // namespace
}  // namespace vantage
