// SPDX-License-Identifier: MIT
#include "spatial/point_rings.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage::test {
namespace {

using testing::ElementsAre;

std::vector<Vec3> grid(int side) {
  std::vector<Vec3> points;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      points.emplace_back(x, y, 0.0);
    }
  }
  return points;
}

std::vector<std::uint32_t> sorted_ring(const PointRings& rings, std::size_t point) {
  const auto ring = rings.neighbours[point];
  std::vector<std::uint32_t> sorted(ring.begin(), ring.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

TEST(PointRings, NeighbourhoodIsClampedToEightAndThirty) {
  EXPECT_EQ(neighbourhood_size(100), 8U);
  EXPECT_EQ(neighbourhood_size(1000), 12U);
  EXPECT_EQ(neighbourhood_size(100'000), 30U);
}

TEST(PointRings, GridPointHasItsFourNearestWhereFourPointsShareACircle) {
  const PointRings rings = point_rings(grid(5), 9);
  EXPECT_THAT(sorted_ring(rings, 12), ElementsAre(7, 11, 13, 17));
  EXPECT_EQ(rings.closed[12], 1);
}

TEST(PointRings, CornerOfAGridHasAnOpenRing) {
  const PointRings rings = point_rings(grid(5), 9);
  EXPECT_EQ(rings.closed[0], 0);
}

TEST(PointRings, PointsOnALineHaveNoTriangles) {
  std::vector<Vec3> line;
  for (int i = 0; i < 20; ++i) {
    line.emplace_back(i, 2.0 * i, -i);
  }
  EXPECT_TRUE(agreed_triangles(point_rings(line, 8), 1).empty());
}

/// Whether no third point lies in the smallest circle that a triangle of the star could have: the
/// definition of Delaunay, tried over all pairs.
TEST(PointRings, StarsOfFlatPointsAreDelaunay) {
  std::vector<Vec3> points;
  unsigned state = 7;
  const auto next = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8U) / 16777216.0;
  };
  for (int i = 0; i < 30; ++i) {
    const double x = next();
    points.emplace_back(x, next(), 0.0);
  }
  const PointRings rings = point_rings(points, points.size());
  int checked = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    rings.each_triangle(i, [&](std::uint32_t a, std::uint32_t b) {
      const Vec3 u = points[a] - points[i];
      const Vec3 v = points[b] - points[i];
      const double twice = 2.0 * (u.x() * v.y() - u.y() * v.x());
      const Vec3 centre(points[i].x() + (v.y() * u.squaredNorm() - u.y() * v.squaredNorm()) / twice,
                        points[i].y() + (u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) / twice,
                        0.0);
      const double radius = (points[i] - centre).norm();
      for (const Vec3& p : points) {
        EXPECT_GE((p - centre).norm(), radius * (1.0 - 1e-7));
      }
      ++checked;
    });
  }
  EXPECT_GT(checked, 90);  // 3 stars hold each of more than 30 triangles
}

TEST(PointRings, SampleIsSpreadAndCovers) {
  const std::vector<Vec3> points = grid(60);
  const auto sample = spread_sample(points, 200);
  EXPECT_LE(sample.size(), 200U);
  EXPECT_GE(sample.size(), 100U);
}

}  // namespace
}  // namespace vantage::test
