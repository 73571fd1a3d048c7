// SPDX-License-Identifier: MIT
#include "pipeline/twins.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

TEST(Twins, OfAViewOfABoxAreItsMirrorImages) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 8));
  ShapeAnalysis shape = prepare_surface(model);
  const std::vector<double> even(shape.surface.positions.size(), 1.0);
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ViewScorer scorer(visibility, even, scoring_camera(shape, {}));
  const Vec3 best = Vec3(1.0, 2.0, 3.0).normalized();
  ViewOptions options;
  options.objective = Objective::Significance;
  const Preference preference(shape, {}, options, scorer.total());
  const auto twins = twins_of(
      best, shape, [&](const std::vector<Vec3>& at) { return scorer.score_all(at); }, preference);
  // Three planes make 2³ images, the view itself among them; on an even map all see as much.
  ASSERT_EQ(twins.size(), 7U);
  for (const TwinView& twin : twins) {
    EXPECT_EQ(twin.score, scorer.score(twin.direction));
    EXPECT_GE(twin.score, 0.98 * scorer.score(best));
    EXPECT_EQ(twin.objective, twin.score);
    // The planes are those of samples, whose principal axes are not exact.
    EXPECT_NEAR((twin.direction.cwiseAbs() - best).norm(), 0.0, 1e-4);
  }
}

TEST(NearTies, GoToTheFrontAndThenToTheSide) {
  const UprightFrame frame;
  TwinView best{Vec3(-0.6, 0.0, -0.8), 10.0, 10.0};
  std::vector<TwinView> twins{{Vec3(-0.6, 0.0, 0.8), 10.0, 9.95},
                              {Vec3(0.6, 0.0, 0.8), 10.0, 9.96},
                              {Vec3(0.6, 0.0, -0.8), 10.0, 10.0}};
  settle_near_ties(best, twins, frame);
  EXPECT_EQ(best.direction, Vec3(0.6, 0.0, 0.8));
  ASSERT_EQ(twins.size(), 3U);
  for (const TwinView& twin : twins) {
    EXPECT_NE(twin.direction, best.direction);
  }
}

TEST(Sides, GoToTheRightThoughTheMeshMakesTheirScoresDiffer) {
  const auto seventh_power = [](const Vec3& direction, double score) {
    return (direction.z() < 0.0 ? 0.9 : 1.0) * std::pow(score, 7.0);
  };
  const Vec3 left(-0.6, 0.0, 0.8);
  const Vec3 right(0.6, 0.01, 0.79);
  const auto view_of = [&](const Vec3& direction, double score) {
    return TwinView{direction, score, seventh_power(direction, score)};
  };
  TwinView best = view_of(left, 1.0);
  std::vector<TwinView> twins{view_of(right, 0.995)};
  settle_near_ties(best, twins, {});
  EXPECT_EQ(best.direction, left);  // 3.5 % less
  settle_sides(best, twins, {}, seventh_power);
  EXPECT_EQ(best.direction, right);
  EXPECT_EQ(twins[0].direction, left);
  settle_sides(best, twins, {}, seventh_power);
  EXPECT_EQ(best.direction, right);
}

TEST(Sides, StayWhereTheOtherIsPreferredOrNoMirrorImageBetweenLeftAndRight) {
  TwinView best{Vec3(-0.6, 0.0, 0.8), 1.0, 1.0};
  std::vector<TwinView> twins{{Vec3(0.6, 0.0, 0.8), 0.99, 0.97}};
  settle_sides(best, twins, {}, [](const Vec3& direction, double score) {
    return (direction.x() > 0.0 ? 0.98 : 1.0) * score;
  });
  EXPECT_EQ(best.direction.x(), -0.6);
  twins = {{Vec3(0.6, 0.0, -0.8), 1.0, 1.0}, {Vec3(-0.6, 0.0, -0.8), 1.0, 1.0}};
  settle_sides(best, twins, {}, [](const Vec3& /*direction*/, double score) { return score; });
  EXPECT_EQ(best.direction.x(), -0.6);
}

TEST(NearTies, LeaveABestThatIsClearlyBetter) {
  TwinView best{Vec3(-0.6, 0.0, -0.8), 10.0, 10.0};
  std::vector<TwinView> twins{{Vec3(0.6, 0.0, 0.8), 9.85, 9.85}};
  settle_near_ties(best, twins, {});
  EXPECT_EQ(best.direction, Vec3(-0.6, 0.0, -0.8));
}

}  // namespace
}  // namespace vantage::test
