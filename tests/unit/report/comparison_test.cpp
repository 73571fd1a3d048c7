// SPDX-License-Identifier: MIT
#include "vantage/report/comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage {
namespace {

TEST(RankCorrelation, IsOneForAnyRisingChange) {
  EXPECT_DOUBLE_EQ(
      rank_correlation(std::vector<double>{1, 2, 5, 3}, std::vector<double>{1, 8, 125, 27}), 1.0);
}

TEST(RankCorrelation, IsMinusOneForTheReverse) {
  EXPECT_DOUBLE_EQ(rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{9, 8, 1}),
                   -1.0);
}

TEST(RankCorrelation, GivesTiesTheirMeanRank) {
  // Ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3: covariance 4.5, variances 4.5 and 5.
  EXPECT_NEAR(rank_correlation(std::vector<double>{1, 2, 2, 3}, std::vector<double>{1, 2, 3, 4}),
              4.5 / std::sqrt(4.5 * 5.0), 1e-12);
}

TEST(RankCorrelation, OfAFlatListIsNoNumber) {
  EXPECT_TRUE(std::isnan(rank_correlation(std::vector<double>{1, 1}, std::vector<double>{1, 2})));
}

TEST(CompareMethods, ReportsFractionsThatNeverDecrease) {
  const ShapeAnalysis shape = analyse_shape(test::model_of(test::box(1.0, 2.0, 3.0, 2)), {});
  double last = 0.0;
  const RunContext run{.report = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }};
  (void)compare_methods(shape, {}, {find_measure("projected-area"), find_measure("mesh-saliency")},
                        run);
  EXPECT_EQ(last, 1.0);
}

TEST(FoldedAngle, TakesTheNearestMirrorImage) {
  const std::vector<MirrorPlane> planes{{.normal = Vec3::UnitX()}};
  const Vec3 left = Vec3(-1, 0, 1).normalized();
  const Vec3 right = Vec3(1, 0, 1).normalized();
  EXPECT_NEAR(angle_deg(left, right), 90.0, 1e-9);
  EXPECT_NEAR(folded_angle_deg(left, right, planes), 0.0, 1e-6);
}

TEST(FoldedAngle, CombinesTwoMirrors) {
  const std::vector<MirrorPlane> planes{{.normal = Vec3::UnitX()}, {.normal = Vec3::UnitZ()}};
  EXPECT_NEAR(folded_angle_deg(Vec3(1, 0, 2).normalized(), Vec3(-1, 0, -2).normalized(), planes),
              0.0, 1e-6);
}

}  // namespace
}  // namespace vantage
