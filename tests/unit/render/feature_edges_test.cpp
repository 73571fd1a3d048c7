// SPDX-License-Identifier: MIT
#include "render/feature_edges.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr double kCreaseRad = 40.0 * std::numbers::pi / 180.0;
constexpr double kLong = 100.0;

TEST(FeatureEdges, OfABoxAreItsTwelveEdges) {
  const CurveGraph edges = feature_edges(test::box(1, 2, 3, 4), kCreaseRad, 0.0, kLong);
  EXPECT_NEAR(total_length(edges), 4.0 * (1 + 2 + 3), 1e-12);
  EXPECT_EQ(edges.edges.size(), 12U * 4U);
}

TEST(FeatureEdges, OfACylinderAreItsTwoRims) {
  const int around = 24;  // neighbours bend by 15°
  const CurveGraph edges =
      feature_edges(test::cylinder(1.0, 2.0, around, 3), kCreaseRad, 0.0, kLong);
  const double rim = around * 2.0 * std::sin(std::numbers::pi / around);
  EXPECT_NEAR(total_length(edges), 2.0 * rim, 1e-12);
}

TEST(FeatureEdges, OfASheetAreItsBorder) {
  EXPECT_NEAR(total_length(feature_edges(test::sheet(2, 1, 3), kCreaseRad, 0.0, kLong)), 6.0,
              1e-12);
}

TEST(FeatureEdges, ASphereHasNone) {
  EXPECT_TRUE(feature_edges(test::sphere(4), kCreaseRad, 0.0, kLong).edges.empty());
}

TEST(FeatureEdges, DependOnPositionsNotOnSharedVerticesOrWinding) {
  const TriMesh box = test::box(1, 2, 3, 2);
  TriMesh mixed = box;
  for (std::size_t f = 0; f < mixed.triangles.size(); f += 3) {
    std::swap(mixed.triangles[f][0], mixed.triangles[f][1]);
  }
  for (const TriMesh& mesh : {test::soup(box), test::inside_out(box), mixed}) {
    EXPECT_NEAR(total_length(feature_edges(mesh, kCreaseRad, 0.0, kLong)), 24.0, 1e-12);
  }
}

TEST(FeatureEdges, AFoldBackOnItselfIsOne) {
  // Two faces of a knife's edge, 5° apart.
  TriMesh knife;
  const double thin = std::tan(2.5 * std::numbers::pi / 180.0);
  knife.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, thin}, {0, 1, -thin}};
  knife.triangles = {{0, 1, 2}, {1, 0, 3}};
  const CurveGraph edges = feature_edges(knife, kCreaseRad, 0.0, kLong);
  EXPECT_EQ(edges.edges.size(), 5U);  // the fold and four borders
}

TEST(FeatureEdges, ShortPiecesAreLeftOut) {
  const TriMesh mesh =
      test::together(test::box(1, 1, 1, 1), test::box(0.01, 0.01, 0.01, 1), Vec3(3, 0, 0));
  EXPECT_NEAR(total_length(feature_edges(mesh, kCreaseRad, 0.5, kLong)), 12.0, 1e-12);
  EXPECT_NEAR(total_length(feature_edges(mesh, kCreaseRad, 0.0, kLong)), 12.12, 1e-12);
}

TEST(FeatureEdges, LongOnesAreSplitIntoEqualPieces) {
  const CurveGraph edges = feature_edges(test::box(1, 1, 1, 1), kCreaseRad, 0.0, 0.3);
  EXPECT_EQ(edges.edges.size(), 12U * 4U);
  for (const auto& edge : edges.edges) {
    ASSERT_NEAR((edges.nodes[edge[0]] - edges.nodes[edge[1]]).norm(), 0.25, 1e-12);
  }
}

TEST(FeatureEdges, AreSplitIntoABoundedNumberOfPieces) {
  TriMesh boxes;
  for (int i = 0; i < 50; ++i) {
    boxes = test::together(boxes, test::box(1, 1, 1, 1), Vec3(2.0 * i, 0, 0));
  }
  // As from an eye in their middle, where a pixel has no size.
  const CurveGraph edges = feature_edges(boxes, kCreaseRad, 0.0, 1e-300);
  EXPECT_LE(edges.edges.size(), kMostFeatureEdges + 50U * 12U);
  EXPECT_NEAR(total_length(edges) / (50.0 * 12.0), 1.0, 1e-9);
}

}  // namespace
}  // namespace vantage
