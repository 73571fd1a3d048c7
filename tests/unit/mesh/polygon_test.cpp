// SPDX-License-Identifier: MIT
#include "mesh/polygon.h"

#include <cmath>
#include <cstddef>
#include <ctime>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "core/random.h"
#include "support/worst.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;

/// The polygon through all `points` in order, triangulated.
TriMesh triangulated(std::vector<Vec3> points) {
  const RunContext run;
  PolygonWork work(run);
  TriMesh mesh;
  mesh.positions = std::move(points);
  std::vector<std::uint32_t> corners(mesh.positions.size());
  std::iota(corners.begin(), corners.end(), 0U);
  triangulate_polygon(corners, mesh.positions, work, mesh.triangles);
  return mesh;
}

/// Areas against the polygon's normal: a triangle that lies outside or is turned over is negative.
double least_signed_area(const TriMesh& mesh, const Vec3& normal) {
  double least = 1e300;
  for (const Triangle& t : mesh.triangles) {
    least = smaller(least, 0.5 * area_vector(mesh, t).dot(normal));
  }
  return least;
}

/// Area by the shoelace formula, for points in the plane z = 0.
double shoelace(const std::vector<Vec3>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& a = points[i];
    const Vec3& b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

/// A star-shaped polygon with random radii: concave nearly everywhere.
std::vector<Vec3> ragged(int n, unsigned seed) {
  Pcg32 random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const double radius = 0.2 + random.uniform();
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return points;
}

/// A comb: teeth as thin as they are many.
std::vector<Vec3> comb(int teeth) {
  std::vector<Vec3> points = {Vec3(teeth, -1, 0)};
  for (int i = teeth; i > 0; --i) {
    points.emplace_back(i - 0.25, 1.0 * teeth, 0.0);
    points.emplace_back(i - 1.0, 0.0, 0.0);
  }
  points.emplace_back(0.0, -1.0, 0.0);
  return points;
}

TEST(TriangulatePolygon, LeavesATriangleAsItIs) {
  EXPECT_THAT(triangulated({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}).triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(TriangulatePolygon, GivesNothingForFewerThanThreeCorners) {
  EXPECT_TRUE(triangulated({Vec3(0, 0, 0), Vec3(1, 0, 0)}).triangles.empty());
  EXPECT_TRUE(triangulated({}).triangles.empty());
}

TEST(TriangulatePolygon, CutsAConvexQuadFromItsFirstCorner) {
  EXPECT_THAT(triangulated({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}).triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(TriangulatePolygon, CutsADartThroughItsNotch) {
  const std::vector<Vec3> dart = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, 1, 0), Vec3(0, 4, 0)};
  for (std::size_t shift = 0; shift < 4; ++shift) {
    std::vector<Vec3> turned = dart;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(shift), turned.end());
    const TriMesh mesh = triangulated(turned);
    EXPECT_GT(least_signed_area(mesh, Vec3::UnitZ()), 0.0) << shift;
    EXPECT_NEAR(surface_area(mesh), 4.0, 1e-14) << shift;  // two triangles of area 4 · 1 / 2
  }
}

TEST(TriangulatePolygon, CoversAConcavePolygonOnceInAnyPlaneAndScale) {
  const std::vector<Vec3> flat = ragged(57, 3);
  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
  for (const double scale : {1e-50, 1.0, 1e50}) {
    std::vector<Vec3> points;
    for (const Vec3& p : flat) {
      const Vec3 turned = turn * p;
      points.emplace_back(scale * turned + Vec3::Constant(scale));
    }
    const TriMesh mesh = triangulated(points);
    EXPECT_EQ(mesh.triangles.size(), 55U);
    EXPECT_GT(least_signed_area(mesh, turn * Vec3::UnitZ()), 0.0);
    EXPECT_NEAR(surface_area(mesh) / (scale * scale), shoelace(flat), 1e-12);
  }
}

TEST(TriangulatePolygon, KeepsTheWinding) {
  std::vector<Vec3> points = ragged(40, 5);
  std::reverse(points.begin(), points.end());
  EXPECT_GT(least_signed_area(triangulated(points), -Vec3::UnitZ()), 0.0);
}

TEST(TriangulatePolygon, MakesNoEmptyTriangleWhereCornersLieOnASide) {
  const TriMesh mesh = triangulated(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(1, 2, 0), Vec3(0, 2, 0)});
  EXPECT_GT(least_signed_area(mesh, Vec3::UnitZ()), 0.1);
  EXPECT_NEAR(surface_area(mesh), 4.0, 1e-14);
}

TEST(TriangulatePolygon, CutsAroundAHoleThatABridgeConnects) {
  // A square of side 4 with a square hole of side 2; corners 0 and 5 both stand at the bridge.
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 4, 0), Vec3(0, 4, 0),
                                    Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 3, 0), Vec3(3, 3, 0),
                                    Vec3(3, 1, 0), Vec3(1, 1, 0)};
  const TriMesh mesh = triangulated(points);
  EXPECT_EQ(mesh.triangles.size(), 8U);
  EXPECT_GE(least_signed_area(mesh, Vec3::UnitZ()), 0.0);
  EXPECT_NEAR(surface_area(mesh), 4.0 * 4.0 - 2.0 * 2.0, 1e-13);
}

TEST(TriangulatePolygon, AlwaysGivesTwoTrianglesFewerThanCorners) {
  const std::vector<Vec3> same(9, Vec3(1, 1, 1));
  EXPECT_EQ(triangulated(same).triangles.size(), 7U);
  std::vector<Vec3> pentagram;
  pentagram.reserve(5);
  for (int i = 0; i < 5; ++i) {
    const double angle = 4.0 * std::numbers::pi * i / 5.0;  // goes round twice
    pentagram.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  EXPECT_EQ(triangulated(pentagram).triangles.size(), 3U);
  Pcg32 random(1);
  std::vector<Vec3> tangle;
  tangle.reserve(300);
  for (int i = 0; i < 300; ++i) {
    tangle.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  EXPECT_EQ(triangulated(tangle).triangles.size(), 298U);
}

TEST(TriangulatePolygon, TakesTwoHundredThousandCornersOfACircleOrAComb) {
  constexpr int kCorners = 200'000;
  std::vector<Vec3> circle;
  circle.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  EXPECT_NEAR(surface_area(triangulated(circle)), std::numbers::pi, 1e-9);
  const std::vector<Vec3> teeth = comb(kCorners / 2);
  EXPECT_NEAR(surface_area(triangulated(teeth)) / shoelace(teeth), 1.0, 1e-9);
}

TEST(TriangulatePolygon, CoversARaggedPolygonOfAHundredThousandCorners) {
  const std::vector<Vec3> points = ragged(100'000, 9);
  const TriMesh mesh = triangulated(points);
  EXPECT_NEAR(surface_area(mesh), shoelace(points), 1e-9);
}

TEST(TriangulatePolygon, FewTrianglesOfAConvexPolygonMeetInACorner) {
  std::vector<Vec3> points;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 64.0;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const TriMesh mesh = triangulated(points);
  std::vector<int> met(points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      ++met[corner];
    }
  }
  EXPECT_EQ(mesh.triangles.size(), 62U);
  EXPECT_GT(least_signed_area(mesh, Vec3::UnitZ()), 0.0);
  EXPECT_NEAR(surface_area(mesh), shoelace(points), 1e-14);
  EXPECT_LE(*std::max_element(met.begin(), met.end()), 12);  // 2 log2 64; 62 where all meet in one
}

/// Corners all over a square, whose sides cross each other.
std::vector<Vec3> tangle(int corners) {
  Pcg32 random(4);
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    points.emplace_back(random.uniform(), random.uniform(), 0.0);
  }
  return points;
}

TEST(TriangulatePolygon, SharesItsWorkAmongAllPolygonsOfAModel) {
  const std::vector<Vec3> points = tangle(1000);
  std::vector<std::uint32_t> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0U);
  const RunContext run;
  PolygonWork work(run);
  std::vector<Triangle> triangles;
  triangulate_polygon(corners, points, work, triangles);
  EXPECT_FALSE(work.is_spent());  // one has enough
  constexpr std::size_t kPolygons = 40;
  for (std::size_t i = 1; i < kPolygons; ++i) {
    triangulate_polygon(corners, points, work, triangles);
  }
  EXPECT_EQ(triangles.size(), kPolygons * (corners.size() - 2));
  EXPECT_TRUE(work.is_spent());
}

TEST(TriangulatePolygon, StopsWithinAPolygon) {
  const std::vector<Vec3> points = tangle(3000);
  std::vector<std::uint32_t> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0U);
  std::stop_source source;
  source.request_stop();
  RunContext run;
  run.stop = source.get_token();
  PolygonWork work(run);
  std::vector<Triangle> triangles;
  EXPECT_THROW(triangulate_polygon(corners, points, work, triangles), Cancelled);
}

TEST(TriangulatePolygon, EndsSoonWhereItsCornersStandInNinePlaces) {
  constexpr int kCorners = 200'000;
  std::vector<Vec3> points;
  points.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    points.emplace_back(i % 3, i % 9 / 3, i % 9 % 2);
  }
  const std::clock_t begin = std::clock();
  EXPECT_EQ(triangulated(points).triangles.size(), std::size_t{kCorners} - 2);
  constexpr double kMostSeconds = 12.0;  // 0.4, and 16 where the work of a round was not bounded
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kMostSeconds);
}

}  // namespace
}  // namespace vantage::test
