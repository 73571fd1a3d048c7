// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/skeleton/skeleton.h"

#include "support/dense_oracles.h"
#include "support/once.h"
#include "support/shapes.h"
#include "support/skeletons.h"
#include "support/voxel_surface.h"
#include "support/worst.h"

namespace vantage {
namespace {

using test::ends_of;
using test::skeleton_of;

constexpr double kMinor = 0.25;   // radius of the torus's tube
constexpr double kRadius = 0.25;  // of the cylinder

TriMesh torus() {
  return test::torus(1.0, kMinor, 60, 20);
}

/// Of length 4.
TriMesh cylinder() {
  return test::cylinder(kRadius, 4.0, 24, 48);
}

/// Their skeletons and that of a Y of tubes, finished or not. Each found once a process.
const Skeleton& torus_skeleton() {
  static const Skeleton skeleton = skeleton_of(torus());
  return skeleton;
}

const Skeleton& cylinder_skeleton() {
  static const Skeleton skeleton = skeleton_of(cylinder());
  return skeleton;
}

const Skeleton& y_skeleton(bool is_finished) {
  static const TriMesh mesh = test::y_of_tubes(0.25, 20);
  static const ContractionHistory history = contract(mesh);
  return test::once(is_finished, [&] {
    return is_finished ? extract_skeleton(mesh, history)
                       : extract_skeleton(mesh, history, {.centre = false, .prune = false});
  });
}

TEST(ExtractSkeleton, OfATorusIsOneCycleNearItsCoreCircle) {
  const Skeleton& skeleton = torus_skeleton();
  EXPECT_EQ(cycle_count(skeleton.graph), 1U);
  EXPECT_EQ(component_count(skeleton.graph), 1U);
  double worst = 0.0;
  for (const Vec3& p : skeleton.graph.nodes) {
    worst = test::larger(worst, std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()));
  }
  RecordProperty("farthest_from_circle_in_tube_radii", std::to_string(worst / kMinor));
  EXPECT_LE(worst, kMinor);
}

TEST(ExtractSkeleton, HasNoLoopsAroundSingleTrianglesThatTheSurfaceLacks) {
  TriMesh mesh = cylinder();
  std::vector<Triangle> kept;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (f % 37 != 0) {
      kept.push_back(mesh.triangles[f]);
    }
  }
  mesh.triangles.swap(kept);
  const CurveGraph graph = skeleton_of(mesh).graph;
  EXPECT_EQ(cycle_count(graph), 0U);
  EXPECT_EQ(ends_of(graph).size(), 2U);
}

TEST(ExtractSkeleton, OfATorusHasTheLengthOfItsCoreCircle) {
  EXPECT_NEAR(total_length(torus_skeleton().graph), 2.0 * std::numbers::pi,
              0.05 * 2.0 * std::numbers::pi);
}

TEST(ExtractSkeleton, OfATorusHasTheRadiusOfItsTube) {
  for (const double radius : torus_skeleton().radius) {
    EXPECT_NEAR(radius, kMinor, 0.1 * kMinor);
  }
}

/// A cylinder of radius 1 and height 8 with a bore of radius 0.4 along its axis.
TriMesh bored_cylinder() {
  constexpr int kAlong = 20;
  constexpr int kSection = 2 * (kAlong + 1);  // up outside, down inside
  TriMesh mesh = test::torus(1.0, 0.25, 24, kSection);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3& p = mesh.positions[v];
    const int place = static_cast<int>(v % kSection);
    const bool is_outside = place <= kAlong;
    const double z = 8.0 * (is_outside ? place : kSection - 1 - place) / kAlong;
    const double angle = std::atan2(p.y(), p.x());
    const double radius = is_outside ? 1.0 : 0.4;
    p = Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return mesh;
}

TEST(ExtractSkeleton, OfABoredCylinderFollowsOneSideOfItsWall) {
  const Skeleton skeleton = skeleton_of(bored_cylinder());
  EXPECT_EQ(cycle_count(skeleton.graph), 1U);
  EXPECT_EQ(skeleton.outside_share, 0.0);
  RecordProperty("length", std::to_string(total_length(skeleton.graph)));
  EXPECT_LT(total_length(skeleton.graph), 2.0 * 8.0);  // a loop goes there and back
}

TEST(ExtractSkeleton, OfASphereHasNoCycleAndIsShort) {
  const Skeleton skeleton = skeleton_of(test::sphere(3));
  EXPECT_EQ(cycle_count(skeleton.graph), 0U);
  EXPECT_EQ(component_count(skeleton.graph), 1U);
  EXPECT_LE(total_length(skeleton.graph), 1.0);  // half the diameter
}

TEST(ExtractSkeleton, OfACylinderIsAPathOnItsAxis) {
  const Skeleton& skeleton = cylinder_skeleton();
  EXPECT_EQ(ends_of(skeleton.graph).size(), 2U);
  EXPECT_THAT(node_degrees(skeleton.graph), ::testing::Each(::testing::Le(2U)));
  for (const Vec3& p : skeleton.graph.nodes) {
    EXPECT_LE(std::hypot(p.x(), p.y()), 0.05 * kRadius);
  }
}

TEST(ExtractSkeleton, OfACylinderReachesNearBothCaps) {
  std::vector<Vec3> ends = ends_of(cylinder_skeleton().graph);
  ASSERT_EQ(ends.size(), 2U);
  std::sort(ends.begin(), ends.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  RecordProperty("end_depth_in_radii", std::to_string(ends[0].z() / kRadius));
  EXPECT_GE(ends[0].z(), 0.0);
  EXPECT_LE(ends[0].z(), 2.0 * kRadius);
  EXPECT_LE(ends[1].z(), 4.0);
  EXPECT_GE(ends[1].z(), 4.0 - 2.0 * kRadius);
}

TEST(ExtractSkeleton, OfAnOpenCylinderIsAPath) {
  const Skeleton skeleton = skeleton_of(test::open_cylinder(0.25, 4.0, 24, 48));
  EXPECT_EQ(cycle_count(skeleton.graph), 0U);
  EXPECT_EQ(ends_of(skeleton.graph).size(), 2U);
  EXPECT_GE(total_length(skeleton.graph), 4.0 - 4.0 * 0.25);
}

TEST(ExtractSkeleton, OfAYHasOneJunctionAndThreeEndsNearItsTips) {
  const double radius = 0.2;
  const Skeleton skeleton = skeleton_of(test::y_of_tubes(radius, 28));
  const auto degree = node_degrees(skeleton.graph);
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 3U), 1);
  EXPECT_EQ(std::count_if(degree.begin(), degree.end(), [](std::size_t d) { return d > 3; }), 0);
  const std::vector<Vec3> ends = ends_of(skeleton.graph);
  ASSERT_EQ(ends.size(), 3U);
  for (const double degrees : {90.0, 210.0, 330.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 axis_end(std::cos(angle), std::sin(angle), 0.0);
    double nearest = 1e9;
    for (const Vec3& end : ends) {
      nearest = test::smaller(nearest, (end - axis_end).norm());
    }
    EXPECT_LE(nearest, 2.0 * radius) << degrees;
  }
}

TEST(ExtractSkeleton, KeepsTheHandlesOfAPlateWithTwoAndThreeHoles) {
  EXPECT_EQ(cycle_count(skeleton_of(test::plate_with_holes(2)).graph), 2U);
  EXPECT_EQ(cycle_count(skeleton_of(test::plate_with_holes(3)).graph), 3U);
}

TEST(ExtractSkeleton, KeepsTheFiveHandlesOfACubeFrame) {
  EXPECT_EQ(cycle_count(skeleton_of(test::cube_frame()).graph), 5U);
}

TEST(ExtractSkeleton, KeepsTheHandlesOfALattice) {
  // The bars of a cube of 2 × 2 × 2: 27 crossings, 54 bars.
  const auto is_bar = [](int i, int j, int k) { return i % 2 + j % 2 + k % 2 <= 1; };
  EXPECT_EQ(cycle_count(skeleton_of(test::voxel_surface(5, 5, 5, is_bar)).graph), 54U - 27U + 1U);
}

TEST(ExtractSkeleton, KeepsAHandleMuchSmallerThanTheSpacing) {
  // A plate of 50 cells with one hole of a single cell: 1/50 of the length.
  const TriMesh mesh =
      test::voxel_surface(50, 5, 2, [](int i, int j, int) { return !(i == 25 && j == 2); });
  EXPECT_EQ(cycle_count(skeleton_of(mesh, {.spacing = 0.2}).graph), 1U);
}

TEST(ExtractSkeleton, OfTwoToriHasTwoComponentsAndTwoCycles) {
  const TriMesh torus = test::torus(1.0, 0.25, 40, 14);
  const Skeleton skeleton = skeleton_of(test::together(torus, torus, Vec3(4, 0, 0)));
  EXPECT_EQ(component_count(skeleton.graph), 2U);
  EXPECT_EQ(cycle_count(skeleton.graph), 2U);
}

TEST(ExtractSkeleton, KnowsTheNodeOfEveryVertexButIsolatedOnes) {
  TriMesh mesh = test::y_of_tubes(0.25, 20);
  mesh.positions.emplace_back(9, 9, 9);
  Skeleton skeleton = skeleton_of(mesh);
  ASSERT_EQ(skeleton.node_of_vertex.size(), mesh.positions.size());
  ASSERT_EQ(skeleton.raw_node_of_vertex.size(), mesh.positions.size());
  EXPECT_EQ(skeleton.node_of_vertex.back(), Skeleton::kNone);
  EXPECT_EQ(skeleton.raw_node_of_vertex.back(), Skeleton::kNone);
  skeleton.node_of_vertex.pop_back();
  skeleton.raw_node_of_vertex.pop_back();
  EXPECT_THAT(skeleton.node_of_vertex, ::testing::Each(::testing::Lt(skeleton.graph.nodes.size())));
  EXPECT_THAT(skeleton.raw_node_of_vertex,
              ::testing::Each(::testing::Lt(skeleton.raw.nodes.size())));
}

TEST(ExtractSkeleton, HasARadiusForEveryNode) {
  const Skeleton& skeleton = y_skeleton(true);
  ASSERT_EQ(skeleton.radius.size(), skeleton.graph.nodes.size());
  EXPECT_THAT(skeleton.radius, ::testing::Each(::testing::Gt(0.0)));
}

TEST(ExtractSkeleton, WithoutCentringAndPruningIsTheRawGraph) {
  const Skeleton& skeleton = y_skeleton(false);
  EXPECT_EQ(skeleton.graph.nodes, skeleton.raw.nodes);
  EXPECT_EQ(skeleton.graph.edges, skeleton.raw.edges);
  EXPECT_EQ(skeleton.node_of_vertex, skeleton.raw_node_of_vertex);
}

TEST(ExtractSkeleton, LeavesTheRawGraphAloneWhateverFinishesIt) {
  EXPECT_EQ(y_skeleton(true).raw.nodes, y_skeleton(false).raw.nodes);
}

/// A rod with a wart less high than the rod is thick.
TriMesh rod_with_wart() {
  return test::voxel_surface(30, 4, 5, [](int i, int j, int k) {
    return k < 4 || (i >= 14 && i < 16 && j >= 1 && j < 3);
  });
}

TEST(ExtractSkeleton, PrunesWhatIsShorterThanThick) {
  EXPECT_EQ(ends_of(skeleton_of(rod_with_wart()).graph).size(), 2U);
}

TEST(ExtractSkeleton, PrunesNothingLongerThanThick) {
  const TriMesh mesh = test::voxel_surface(
      30, 4, 14, [](int i, int, int k) { return k < 4 || (i >= 14 && i < 18); });
  EXPECT_EQ(ends_of(skeleton_of(mesh).graph).size(), 3U);
}

TEST(ExtractSkeleton, KeepsEveryNodeOfARoundShapeInside) {
  const auto expect_inside = [](const TriMesh& mesh, const Skeleton& skeleton) {
    for (const Vec3& p : skeleton.graph.nodes) {
      EXPECT_NEAR(test::winding_number(mesh, p), 1.0, 1e-9);
    }
  };
  expect_inside(torus(), torus_skeleton());
  expect_inside(cylinder(), cylinder_skeleton());
  const TriMesh tubes = test::y_of_tubes(0.2, 24);
  expect_inside(tubes, skeleton_of(tubes));
}

TEST(ExtractSkeleton, OfNothingIsNothing) {
  EXPECT_TRUE(skeleton_of({}).graph.nodes.empty());
}

TEST(ExtractSkeleton, RefusesAHistoryOfAnotherMesh) {
  const auto history = contract(test::sphere(1), {.method = ContractionMethod::Exact});
  EXPECT_THROW(extract_skeleton(test::sphere(2), history), InvalidInput);
}

TEST(ExtractSkeleton, RefusesASpacingOfNothing) {
  const TriMesh mesh = test::sphere(1);
  const auto history = contract(mesh, {.method = ContractionMethod::Exact});
  EXPECT_THROW(extract_skeleton(mesh, history, {.spacing = 0.0}), InvalidInput);
}

TEST(ExtractSkeleton, SurvivesFacesThatStandTwice) {
  TriMesh mesh = test::torus(1.0, 0.25, 40, 14);
  for (std::size_t f = 0; f < 30; ++f) {
    const Triangle copy = mesh.triangles[f];
    mesh.triangles.push_back(copy);
  }
  const Skeleton skeleton = skeleton_of(mesh);
  EXPECT_EQ(component_count(skeleton.graph), 1U);
  for (const Vec3& p : skeleton.graph.nodes) {
    EXPECT_TRUE(p.allFinite());
  }
}

TEST(ExtractSkeletonProgress, NeverGoesBackAndEndsAtOne) {
  const TriMesh mesh = test::plate_with_holes(3);
  const ContractionHistory history = contract(mesh);
  std::vector<double> seen;
  extract_skeleton(mesh, history, {},
                   {.report = [&](std::string_view, double f) { seen.push_back(f); }});
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
}

TEST(ExtractSkeletonCancel, StopsBeforeItEnds) {
  const TriMesh mesh = test::torus(1.0, 0.25, 20, 8);
  const ContractionHistory history = contract(mesh);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(extract_skeleton(mesh, history, {}, {.stop = source.get_token()}), Cancelled);
}

}  // namespace
}  // namespace vantage
