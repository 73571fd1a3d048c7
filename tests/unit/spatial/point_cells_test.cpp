// SPDX-License-Identifier: MIT
#include "spatial/point_cells.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vantage::test {
namespace {

/// Points between 0 and the extent.
std::vector<Vec3> scattered(std::size_t count, const Vec3& extent, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform() * extent.x(), random.uniform() * extent.y(),
                        random.uniform() * extent.z());
  }
  return points;
}

bool has_near(const std::vector<Vec3>& points, const Vec3& place, double radius) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return (p - place).squaredNorm() <= radius * radius; });
}

TEST(PointCells, FindWhatLookingAtEachPointFinds) {
  for (const Vec3& extent : {Vec3(1.0, 1.0, 1.0), Vec3(1.0, 0.3, 0.0), Vec3(1e-8, 2e-8, 3e-8)}) {
    const std::vector<Vec3> points = scattered(300, extent, 1);
    for (const double share : {1e-4, 0.02, 0.1, 3.0}) {  // below and above the least side of a cell
      const double radius = share * extent.maxCoeff();
      const PointCells cells(points, radius);
      std::size_t found = 0;
      for (const Vec3& place : scattered(500, 1.4 * extent, 2)) {
        const Vec3 moved = place - 0.2 * extent;  // beyond all sides too
        EXPECT_EQ(cells.has_near(moved), has_near(points, moved, radius));
        found += cells.has_near(moved) ? 1 : 0;
      }
      EXPECT_EQ(found == 500, share == 3.0);
    }
  }
}

TEST(PointCells, CountWhatIsExactlyAsFar) {
  const std::vector<Vec3> points{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)};
  const PointCells cells(points, 0.25);
  EXPECT_TRUE(cells.has_near(Vec3(0.5, 0.0, 0.0) + Vec3(0.25, 0.0, 0.0)));
  EXPECT_TRUE(cells.has_near(Vec3(1.0, 0.25, 0.0)));
  EXPECT_FALSE(cells.has_near(Vec3(1.0, 0.2500001, 0.0)));
  EXPECT_FALSE(cells.has_near(Vec3(0.5, 0.0, 0.0)));
}

TEST(PointCells, OfOnePointAreOneCell) {
  const std::vector<Vec3> points(3, Vec3(5.0, 6.0, 7.0));
  const PointCells cells(points, 0.5);
  EXPECT_TRUE(cells.has_near(Vec3(5.0, 6.0, 7.5)));
  EXPECT_FALSE(cells.has_near(Vec3(-1e300, 6.0, 1e300)));
}

}  // namespace
}  // namespace vantage::test
