// SPDX-License-Identifier: MIT
#include "vantage/report/evaluation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// A sphere, on whose upper half people look the longer the higher.
struct Gazed {
  Gazed() {
    model.name = "ball";
    model.mesh = test::sphere(3);
    for (const Vec3& p : model.mesh.positions) {
      record.gaze.push_back(std::max(0.0, p.y()));
    }
  }

  Model model{};
  RecordedModel record{.name = "ball"};
};

TEST(Gaze, OnTheUpperHalfAgreesWithHeight) {
  const Gazed ball;
  const GazeAgreement height = evaluate_gaze(ball.record, ball.model, {}).front();
  EXPECT_EQ(height.map, "height");
  // h = y/2 + 1/2 is uniform on [0, 1]: mean 1/2, deviation 1/√12. Weighted by y over the upper half
  // its mean is ∫ y h / ∫ y = (1/6 + 1/4) / (1/2) = 5/6.
  EXPECT_NEAR(height.chance_adjusted, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(height.normalised, 2.0 / 3.0, 0.02);
  EXPECT_NEAR(height.z_score, std::sqrt(12.0) / 3.0, 0.03);
}

TEST(Gaze, NeedsAValueForEachVertex) {
  Gazed ball;
  ball.record.gaze.pop_back();
  EXPECT_THROW(evaluate_gaze(ball.record, ball.model, {}), InvalidInput);
}

TEST(Bootstrap, OfEqualValuesHasNoWidth) {
  const Interval interval = bootstrap_mean(std::vector<double>{2, 2, 2});
  EXPECT_EQ(interval.low, 2.0);
  EXPECT_EQ(interval.high, 2.0);
}

TEST(Bootstrap, HoldsTheMeanAndLeavesOutWhatHasNoValue) {
  const Interval interval = bootstrap_mean(std::vector<double>{1, 2, 3, std::nan("")});
  EXPECT_DOUBLE_EQ(interval.mean, 2.0);
  EXPECT_LT(interval.low, 2.0);
  EXPECT_GT(interval.high, 2.0);
}

TEST(Bootstrap, OfNothingIsNoNumber) {
  EXPECT_TRUE(std::isnan(bootstrap_mean({}).mean));
}

}  // namespace
}  // namespace vantage
