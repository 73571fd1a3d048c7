// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/skeleton/skeleton.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// A ring whose halves, by the sign of y, have a node each, and an edge across the hole.
Skeleton chord(const TriMesh& ring) {
  Skeleton skeleton;
  skeleton.graph = {.nodes = {Vec3(0, 1, 0), Vec3(0, -1, 0)}, .edges = {{0, 1}}};
  skeleton.radius = {1.0, 1.0};
  for (const Vec3& p : ring.positions) {
    skeleton.node_of_vertex.push_back(p.y() >= 0.0 ? 0 : 1);
  }
  return skeleton;
}

SkeletonQuality measured(const TriMesh& mesh, const Skeleton& skeleton, double thin = 0.0) {
  const std::vector<std::uint32_t> components(mesh.positions.size(), 0);
  return measure_skeleton(mesh, components, skeleton, thin);
}

TEST(MeasureSkeleton, CountsTheLengthInAHoleAsOutside) {
  // Vertices of 40 × 12 lie on the y axis: the hole is 1.5 wide there.
  const TriMesh ring = test::torus(1.0, 0.25, 40, 12);
  const SkeletonQuality quality = measured(ring, chord(ring));
  EXPECT_NEAR(quality.length, 2.0, 1e-12);
  EXPECT_NEAR(quality.outside_length, 1.5, 1e-9);
  EXPECT_EQ(quality.ends, 2U);
}

TEST(MeasureSkeleton, ReportsWhatIsOutsideThinWallsApart) {
  const TriMesh ring = test::torus(1.0, 0.25, 40, 12);  // walls of at most 0.5
  EXPECT_EQ(measured(ring, chord(ring), 0.1).thin_outside, 0.0);
  EXPECT_NEAR(measured(ring, chord(ring), 0.6).thin_outside, 1.5, 1e-9);
}

TEST(MeasureSkeleton, TakesTheFarthestVertexAgainstTheRadiusOfItsNode) {
  // The vertices of the outer circle on the x axis are 1.25 from the chord.
  const TriMesh ring = test::torus(1.0, 0.25, 40, 12);
  Skeleton skeleton = chord(ring);
  skeleton.radius = {0.5, 0.5};
  const SkeletonQuality quality = measured(ring, skeleton);
  EXPECT_NEAR(quality.farthest, 1.25, 1e-12);
  EXPECT_NEAR(quality.farthest_ratio, 2.5, 1e-12);
}

TEST(MeasureSkeleton, SeesAllOfABallFromItsCentreAndNothingFromOutside) {
  const TriMesh ball = test::sphere(2);
  Skeleton skeleton;
  skeleton.graph.nodes = {Vec3::Zero()};
  skeleton.radius = {1.0};
  skeleton.node_of_vertex.assign(ball.positions.size(), 0);
  const SkeletonQuality inside = measured(ball, skeleton);
  EXPECT_EQ(inside.seen_fraction, 1.0);
  EXPECT_NEAR(inside.off_centre, 0.0, 1e-12);
  skeleton.graph.nodes = {Vec3(3, 0, 0)};
  EXPECT_EQ(measured(ball, skeleton).seen_fraction, 0.0);
}

TEST(MeasureSkeleton, RefusesAnotherNumberOfLabelsThanVertices) {
  const TriMesh ball = test::sphere(1);
  EXPECT_THROW((void)measure_skeleton(ball, std::vector<std::uint32_t>(2, 0), {}, 0.0),
               InvalidInput);
}

TEST(MeasureSkeleton, FindsNothingOutsideAnOpenSurface) {
  const TriMesh tube = test::open_cylinder(0.25, 4.0, 24, 48);
  const SkeletonQuality quality = measured(tube, chord(tube));
  EXPECT_EQ(quality.length, 0.0);
  EXPECT_EQ(quality.outside_length, 0.0);
}

TEST(MeasureSkeleton, OfNothingIsNothing) {
  EXPECT_EQ(measured({}, {}).length, 0.0);
}

}  // namespace
}  // namespace vantage
