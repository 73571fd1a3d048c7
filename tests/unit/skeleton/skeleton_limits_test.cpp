// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/core/error.h"
#include "vantage/skeleton/skeleton.h"

#include "support/shapes.h"
#include "support/skeletons.h"
#include "support/voxel_surface.h"
#include "support/worst.h"

namespace vantage {
namespace {

using test::ends_of;
using test::skeleton_of;

TEST(SkeletonOfASingleTriangle, IsOneComponent) {
  const TriMesh triangle{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
  EXPECT_EQ(component_count(skeleton_of(triangle).graph), 1U);
}

TEST(SkeletonOfATetrahedron, IsOneComponentWithoutCycles) {
  const TriMesh tetrahedron{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const Skeleton skeleton = skeleton_of(tetrahedron);
  EXPECT_EQ(component_count(skeleton.graph), 1U);
  EXPECT_EQ(cycle_count(skeleton.graph), 0U);
}

TEST(SkeletonOfATetrahedron, TakesNoHarmFromAFaceOfNoAreaBesideIt) {
  const TriMesh mesh{
      .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 0, 0}, {4, 0, 0}},
      .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 4, 5}}};
  const Skeleton skeleton = skeleton_of(mesh);
  EXPECT_EQ(component_count(skeleton.graph), 1U);  // it is no surface
  EXPECT_EQ(skeleton.node_of_vertex[4], Skeleton::kNone);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_LT((skeleton.graph.nodes[skeleton.node_of_vertex[v]] - mesh.positions[v]).norm(), 1.0);
  }
}

TEST(SkeletonOfACylinder, IsAsThickAsItInItsMiddle) {
  const double radius = 0.25;
  const Skeleton skeleton = skeleton_of(test::cylinder(radius, 4.0, 24, 48));
  std::size_t in_the_middle = 0;
  for (std::size_t i = 0; i < skeleton.graph.nodes.size(); ++i) {
    if (std::abs(skeleton.graph.nodes[i].z() - 2.0) < 1.0) {
      EXPECT_NEAR(skeleton.radius[i], radius, 0.05 * radius);
      ++in_the_middle;
    }
  }
  EXPECT_GT(in_the_middle, 10U);
}

TEST(SkeletonThatIsNotCentred, IsMeasuredAllTheSame) {
  // Samples so far apart that lines between them leave a thin ring.
  const TriMesh ring = test::torus(1.0, 0.05, 64, 8);
  const ContractionHistory history = contract(ring);
  const SkeletonOptions centred{.spacing = 0.3};
  SkeletonOptions left = centred;
  left.centre = false;
  EXPECT_EQ(extract_skeleton(ring, history, centred).outside_share, 0.0);
  EXPECT_GT(extract_skeleton(ring, history, left).outside_share, 0.2);
}

TEST(CurveOfASkeleton, IsThatOfTheFinishedOne) {
  for (const TriMesh& mesh : {test::torus(1.0, 0.2, 48, 12), test::box(1.0, 1.0, 4.0, 1)}) {
    const ContractionHistory history = contract(mesh);
    const Skeleton whole = extract_skeleton(mesh, history);
    const Skeleton curve = extract_curve(mesh, history);
    EXPECT_EQ(curve.raw.nodes, whole.raw.nodes);
    EXPECT_EQ(curve.curve.nodes, whole.curve.nodes);
    EXPECT_EQ(curve.curve.edges, whole.curve.edges);
    EXPECT_EQ(curve.other_curve.nodes, whole.other_curve.nodes);
    EXPECT_EQ(curve.raw_node_of_vertex, whole.raw_node_of_vertex);
    EXPECT_FALSE(whole.graph.nodes.empty());
    EXPECT_TRUE(curve.graph.nodes.empty());
  }
}

TEST(SkeletonOfPaperWithTwoSides, HasNothingToBeOutsideOf) {
  TriMesh paper = test::sheet(1.0, 0.6, 16);
  const std::size_t count = paper.triangles.size();
  for (std::size_t f = 0; f < count; ++f) {
    const auto [a, b, c] = paper.triangles[f];
    paper.triangles.push_back({b, a, c});
  }
  const Skeleton skeleton = skeleton_of(paper);
  EXPECT_FALSE(skeleton.graph.nodes.empty());
  EXPECT_EQ(skeleton.outside_share, 0.0);
}

TEST(SkeletonOfAYOfTubes, EndsWithinATubeRadiusOfTheTips) {
  // Tips are the far points of the round ends, a radius beyond the axes.
  const double radius = 0.2;
  const Skeleton skeleton = skeleton_of(test::y_of_tubes(radius, 28));
  const std::vector<Vec3> ends = ends_of(skeleton.graph);
  for (const double degrees : {90.0, 210.0, 330.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 tip = (1.0 + radius) * Vec3(std::cos(angle), std::sin(angle), 0.0);
    double nearest = 1e9;
    for (const Vec3& end : ends) {
      nearest = test::smaller(nearest, (end - tip).norm());
    }
    EXPECT_LE(nearest, radius) << degrees;
  }
}

TEST(SkeletonWithoutPruning, KeepsTheBranchOfABumpThatPruningCuts) {
  // A bar 4 thick with a bump 2 × 2 wide and 2 high: its branch is no longer than 2 + 4 / 2, the bar
  // at its root at least 4 / 2 thick.
  const TriMesh mesh = test::voxel_surface(30, 4, 6, [](int i, int j, int k) {
    return k < 4 || (i >= 14 && i < 16 && j >= 1 && j < 3);
  });
  const auto ends = [&](const SkeletonOptions& options) {
    return ends_of(skeleton_of(mesh, options).graph).size();
  };
  EXPECT_EQ(ends({.prune_ratio = 2.0}), 2U);
  EXPECT_EQ(ends({.prune_ratio = 2.0, .prune = false}), 3U);
}

/// Without refining first.
constexpr ContractionOptions kQuick{.method = ContractionMethod::Exact};

TEST(SkeletonHistory, WithAnEarlierLevelOfAnotherSizeIsRefused) {
  const TriMesh mesh = test::sphere(1);
  ContractionHistory history = contract(mesh, kQuick);
  ASSERT_GE(history.levels.size(), 2U);
  history.levels.front().pop_back();
  EXPECT_THROW(extract_skeleton(mesh, history), InvalidInput);
}

TEST(SkeletonHistory, OfAMeshThatNothingCanBeComputedWithIsRefused) {
  TriMesh mesh = test::sphere(1);
  const ContractionHistory history = contract(mesh, kQuick);
  for (Vec3& p : mesh.positions) {
    p *= 1e62;
  }
  EXPECT_THROW(extract_skeleton(mesh, history), InvalidInput);
}

TEST(SkeletonHistory, WithoutATableOfComponentsIsRefused) {
  const TriMesh mesh = test::sphere(1);
  ContractionHistory history = contract(mesh, kQuick);
  history.component_of_vertex.clear();
  EXPECT_THROW(extract_skeleton(mesh, history), InvalidInput);
}

}  // namespace
}  // namespace vantage
