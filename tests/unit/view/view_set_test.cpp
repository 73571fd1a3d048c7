// SPDX-License-Identifier: MIT
#include "vantage/view/view_set.h"

#include <cmath>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

/// Views of a closed shape with the same significance everywhere.
class SeenShape {
 public:
  explicit SeenShape(TriMesh shape)
      : mesh(std::move(shape)),
        significance(mesh.positions.size(), 1.0),
        camera{.sphere = enclosing_sphere(mesh.positions)} {}

  [[nodiscard]] ViewSet select(const Vec3& first, const ViewSetOptions& options,
                               const RunContext& run = {}) const {
    const VertexVisibility visibility(mesh, {FaceSides::Front});
    return select_views(visibility, significance, camera, first.normalized(), options, run);
  }

  TriMesh mesh;
  std::vector<double> significance;
  ScoringCamera camera;
};

const SeenShape& cube() {
  static const SeenShape kCube(test::box(1.0, 1.0, 1.0, 1));
  return kCube;
}

TEST(SelectViews, TwoViewsSeeAllCornersOfACube) {
  // From (1,1,1) every corner but (0,0,0) is seen; one further view sees that.
  const ViewSet set = cube().select(Vec3(1, 1, 1), {.level = 2});
  ASSERT_EQ(set.views.size(), 2U);
  EXPECT_EQ(set.views[0].gain, 7.0);
  EXPECT_EQ(set.views[1].gain, 1.0);
  EXPECT_EQ(set.views[1].coverage, 1.0);
  EXPECT_EQ(set.stop, ViewSetStop::Coverage);
}

TEST(SelectViews, NoSingleViewSeesAllCornersOfACube) {
  EXPECT_EQ(cube().select(Vec3(1, 1, 1), {.level = 2}).least_views, 2U);
}

TEST(SelectViews, StopsAtTheNumberAskedFor) {
  const ViewSet set = cube().select(Vec3(1, 1, 1), {.views = 1, .level = 2});
  EXPECT_EQ(set.views.size(), 1U);
  EXPECT_EQ(set.stop, ViewSetStop::Count);
  EXPECT_DOUBLE_EQ(set.views[0].coverage, 7.0 / 8.0);
}

TEST(SelectViews, WhereNothingMoreIsToBeSeenANumberIsNotReached) {
  const ViewSet set = cube().select(Vec3(1, 1, 1), {.views = 4, .level = 2});
  EXPECT_EQ(set.views.size(), 2U);
  EXPECT_EQ(set.stop, ViewSetStop::Exhausted);
  const ViewSetOptions both{.views = 4, .coverage = 1.0, .level = 2};
  EXPECT_EQ(cube().select(Vec3(1, 1, 1), both).stop, ViewSetStop::Coverage);
}

TEST(SelectViews, StopsAtTheCoverageAskedFor) {
  const ViewSet set = cube().select(Vec3(1, 1, 1), {.coverage = 0.875, .level = 2});
  EXPECT_EQ(set.views.size(), 1U);
}

TEST(SelectViews, FirstViewIsTheOneGiven) {
  const Vec3 first = Vec3(0.2, -0.3, 0.9).normalized();
  EXPECT_EQ(cube().select(first, {.level = 2}).views[0].direction, first);
}

TEST(SelectViews, GainsNeverGrowWithoutRefinement) {
  const SeenShape scene(test::torus(1.0, 0.4, 24, 12));
  const ViewSet set = scene.select(Vec3::UnitX(), {.refine = false, .level = 3});
  ASSERT_GE(set.views.size(), 3U);
  for (std::size_t i = 2; i < set.views.size(); ++i) {
    EXPECT_LE(set.views[i].gain, set.views[i - 1].gain) << i;
  }
}

TEST(SelectViews, GainsAddUpToTheCoverage) {
  const SeenShape scene(test::torus(1.0, 0.4, 24, 12));
  const ViewSet set = scene.select(Vec3::UnitX(), {.views = 5, .level = 3});
  ASSERT_EQ(set.views.size(), 3U) << "which see all of it";
  double seen = 0.0;
  for (const ChosenView& view : set.views) {
    seen += view.gain;
    EXPECT_NEAR(view.coverage, seen / set.reachable, 1e-12);
  }
}

TEST(SelectViews, WhatNoViewSeesIsNotReachable) {
  // A box inside a box: the inner one's 8 corners, which come first, are seen from nowhere.
  const SeenShape scene(test::together(test::box(0.2, 0.2, 0.2, 1), test::box(1.0, 1.0, 1.0, 1),
                                       Vec3::Constant(-0.4)));
  const ViewSet set = scene.select(Vec3(1, 1, 1), {.level = 2});
  EXPECT_EQ(set.reachable, 8.0);
  EXPECT_EQ(set.views.back().coverage, 1.0);
}

TEST(SelectViews, KeepsViewsApart) {
  const SeenShape scene(test::torus(1.0, 0.4, 24, 12));
  const ViewSet set =
      scene.select(Vec3::UnitX(), {.views = 4, .min_separation_deg = 80.0, .level = 3});
  ASSERT_EQ(set.views.size(), 3U) << "no fourth is as far";
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double cosine = set.views[i].direction.dot(set.views[j].direction);
      EXPECT_GE(std::acos(cosine), 80.0 * std::numbers::pi / 180.0 - 1e-9);
    }
  }
}

TEST(SelectViews, SaysThatNoViewIsFarEnoughAway) {
  const ViewSet set =
      cube().select(Vec3(1, 1, 1), {.views = 3, .min_separation_deg = 179.9, .level = 0});
  EXPECT_EQ(set.views.size(), 1U);
  EXPECT_EQ(set.stop, ViewSetStop::Exhausted);
}

TEST(SelectViews, RefinementNeverLowersTheFirstGain) {
  const SeenShape scene(test::torus(1.0, 0.4, 40, 20));
  const ViewSet plain = scene.select(Vec3::UnitX(), {.views = 2, .refine = false, .level = 2});
  const ViewSet refined = scene.select(Vec3::UnitX(), {.views = 2, .level = 2});
  EXPECT_GE(refined.views[1].gain, plain.views[1].gain);
}

TEST(SelectViews, IsTheSameForAnyNumberOfThreads) {
  const SeenShape scene(test::torus(1.0, 0.4, 24, 12));
  const ViewSetOptions options{.views = 5, .level = 3};
  const ViewSet one = scene.select(Vec3::UnitX(), options, {.max_threads = 1});
  const ViewSet three = test::with_many_threads(
      [&] { return scene.select(Vec3::UnitX(), options, {.max_threads = 3}); });
  ASSERT_EQ(one.views.size(), three.views.size());
  for (std::size_t i = 0; i < one.views.size(); ++i) {
    EXPECT_EQ(one.views[i].direction, three.views[i].direction);
    EXPECT_EQ(one.views[i].gain, three.views[i].gain);
  }
}

TEST(SelectViews, AMapOfZerosIsCoveredByTheFirstView) {
  SeenShape scene(test::box(1.0, 1.0, 1.0, 1));
  scene.significance.assign(scene.significance.size(), 0.0);
  const ViewSet set = scene.select(Vec3::UnitX(), {.level = 1});
  EXPECT_EQ(set.views.size(), 1U);
  EXPECT_EQ(set.views[0].coverage, 1.0);
}

TEST(SelectViews, RefusesACoverageOfNothing) {
  EXPECT_THROW(std::ignore = cube().select(Vec3::UnitX(), {.coverage = 0.0}), InvalidInput);
  EXPECT_THROW(std::ignore = cube().select(Vec3::UnitX(), {.coverage = 1.5}), InvalidInput);
}

TEST(MeasureViews, GivesTheGainsOfGivenViewsInTheirOrder) {
  const VertexVisibility visibility(cube().mesh, {FaceSides::Front});
  const Vec3 corner = Vec3(1, 1, 1).normalized();
  const std::vector<Vec3> views{Vec3::UnitX(), corner, corner};
  const ViewSet set =
      measure_views(visibility, cube().significance, cube().camera, views, {.level = 2});
  // Along x the 4 corners of one side; then the 7 of (1,1,1) without these; then nothing new.
  EXPECT_EQ(set.views[0].gain, 4.0);
  EXPECT_EQ(set.views[1].gain, 3.0);
  EXPECT_EQ(set.views[2].gain, 0.0);
}

TEST(MeasureViews, ByAreaCountsTheSidesSeenAndNotTheCornersOfHiddenOnes) {
  const FaceVisibility faces(cube().mesh, {FaceSides::Front});
  const ViewScorer scorer(faces, cube().significance, cube().camera);
  const Vec3 corner = Vec3(1, 1, 1).normalized();
  const std::vector<Vec3> views{Vec3::UnitX(), corner, corner};
  const ViewSet set = measure_views(faces, scorer.shares(), cube().camera, views, {.level = 2});
  // One side of six; two more; nothing new.
  EXPECT_NEAR(set.views[0].gain, 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(set.views[1].gain, 2.0 / 6.0, 1e-12);
  EXPECT_EQ(set.views[2].gain, 0.0);
  EXPECT_NEAR(set.reachable, 1.0, 1e-12);
}

TEST(SelectViews, ByAreaCoverACubeFromTwoOppositeCorners) {
  const FaceVisibility faces(cube().mesh, {FaceSides::Front});
  const ViewScorer scorer(faces, cube().significance, cube().camera);
  const ViewSet set =
      select_views(faces, scorer.shares(), cube().camera, Vec3(1, 1, 1).normalized(), {.level = 2});
  ASSERT_EQ(set.views.size(), 2U);
  EXPECT_NEAR(set.views[0].gain, 0.5, 1e-12);
  EXPECT_LT(set.views[1].direction.maxCoeff<Eigen::PropagateNaN>(), 0.0);
  EXPECT_NEAR(set.views[1].coverage, 1.0, 1e-12);
}

}  // namespace
}  // namespace vantage
