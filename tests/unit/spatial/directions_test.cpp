// SPDX-License-Identifier: MIT
#include "vantage/spatial/directions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/topology.h"

namespace vantage {
namespace {

TEST(DirectionSet, OfTheIcosahedronHasTenTimesFourToTheLevelPlusTwoDirections) {
  std::size_t expected = 10;
  for (int level = 0; level <= 5; ++level, expected *= 4) {
    EXPECT_EQ(direction_set(ViewSphereBase::Icosahedron, level).directions.size(), expected + 2);
  }
}

TEST(DirectionSet, OfTheCubeHasSixTimesFourToTheLevelPlusTwoDirections) {
  // 12 faces and 8 corners: V = F / 2 + 2 on a closed triangulation of the sphere.
  std::size_t expected = 6;
  for (int level = 0; level <= 3; ++level, expected *= 4) {
    EXPECT_EQ(direction_set(ViewSphereBase::Cube, level).directions.size(), expected + 2);
  }
}

TEST(DirectionSet, HoldsUnitVectorsOnly) {
  for (const ViewSphereBase base : {ViewSphereBase::Cube, ViewSphereBase::Icosahedron}) {
    for (const Vec3& d : direction_set(base, 3).directions) {
      ASSERT_NEAR(d.norm(), 1.0, 4e-16);
    }
  }
}

TEST(DirectionSet, KeepsTheDirectionsOfCoarserLevelsInFront) {
  const DirectionSet coarse = direction_set(ViewSphereBase::Icosahedron, 1);
  const DirectionSet fine = direction_set(ViewSphereBase::Icosahedron, 2);
  EXPECT_TRUE(
      std::equal(coarse.directions.begin(), coarse.directions.end(), fine.directions.begin()));
}

TEST(DirectionSet, IsAClosedSurfaceWoundOutwards) {
  for (const ViewSphereBase base : {ViewSphereBase::Cube, ViewSphereBase::Icosahedron}) {
    const DirectionSet set = direction_set(base, 1);
    const EdgeTable edges = build_edge_table({set.directions, set.triangles});
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
      ASSERT_EQ(edges.faces_of_edge[e].size(), 2U);
    }
    for (const auto& [a, b, c] : set.triangles) {
      const Vec3& p = set.directions[a];
      ASSERT_GT((set.directions[b] - p).cross(set.directions[c] - p).dot(p), 0.0);
    }
  }
}

TEST(DirectionSet, OfTheCubeSplitsEachSquareFromItsSmallestCornerToTheOpposite) {
  const DirectionSet set = direction_set(ViewSphereBase::Cube, 0);
  const EdgeTable edges = build_edge_table({set.directions, set.triangles});
  int diagonals = 0;
  for (const auto& [a, b] : edges.edges) {
    const Vec3 along = set.directions[b] - set.directions[a];
    // Sides of the square measure 2/√3; a diagonal √2 times that, and its ends have a < b.
    if (along.norm() > 2.0 / std::numbers::sqrt3 * 1.2) {
      ++diagonals;
      // From the lexicographically smallest corner both changing coordinates grow.
      EXPECT_GE(along.minCoeff(), 0.0);
    }
  }
  EXPECT_EQ(diagonals, 6);
}

TEST(DirectionSet, StartsWithTheCornersInLexicographicOrder) {
  const auto directions = direction_set(ViewSphereBase::Icosahedron, 0).directions;
  EXPECT_TRUE(
      std::is_sorted(directions.begin(), directions.end(), [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
      }));
}

TEST(DirectionSet, RefusesLevelsOutsideZeroToEight) {
  EXPECT_THROW(direction_set(ViewSphereBase::Cube, -1), InvalidInput);
  EXPECT_THROW(direction_set(ViewSphereBase::Cube, 9), InvalidInput);
}

TEST(LoopEdgeDirection, WeighsTheEdgeThreeTimesTheOppositeCorners) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  // 3/8 (x + y) + 1/8 (z + x) = (4, 3, 1) / 8.
  EXPECT_NEAR((loop_edge_direction(x, y, z, x) - Vec3(4, 3, 1).normalized()).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace vantage
