// SPDX-License-Identifier: MIT
#include "vantage/mesh/measures.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

using std::numbers::pi;

TEST(SurfaceArea, OfABoxIsTwiceTheSumOfFacePairs) {
  EXPECT_NEAR(surface_area(test::box(1, 2, 3, 3)), 2.0 * (1 * 2 + 2 * 3 + 3 * 1), 1e-13);
}

TEST(SignedVolume, OfABoxIsTheProductOfItsSides) {
  EXPECT_NEAR(signed_volume(test::box(1, 2, 3, 3)), 6.0, 1e-13);
}

TEST(SignedVolume, OfABoxTurnedInsideOutIsNegative) {
  EXPECT_NEAR(signed_volume(test::inside_out(test::box(1, 2, 3, 2))), -6.0, 1e-13);
}

TEST(SignedVolume, SurvivesBeingFarFromTheOrigin) {
  const Vec3 far(1e8, -2e8, 3e8);
  const TriMesh mesh = test::moved(test::box(1, 2, 3, 2), 1.0, 0.0, Vec3::UnitX(), far);
  // Coordinates of 3e8 are rounded to 6e-8.
  EXPECT_NEAR(signed_volume(mesh), 6.0, 1e-6);
}

TEST(SurfaceArea, OfAFineSphereApproachesFourPi) {
  // The area defect of an inscribed polyhedron with edges h is below h²; level 4 has h ≈ 0.07.
  EXPECT_NEAR(surface_area(test::sphere(4)), 4.0 * pi, 4.0 * pi * 0.07 * 0.07);
}

/// The prism over a regular polygon of 20 corners on a circle of `radius`.
struct Prism {
  double radius, height;

  [[nodiscard]] double base() const { return 10.0 * radius * radius * std::sin(pi / 10.0); }

  [[nodiscard]] double wall() const { return 40.0 * radius * std::sin(pi / 20.0) * height; }
};

TEST(SurfaceArea, OfACylinderIsThatOfItsPrism) {
  const Prism prism{.radius = 0.5, .height = 3.0};
  EXPECT_NEAR(surface_area(test::cylinder(0.5, 3.0, 20, 7)), 2.0 * prism.base() + prism.wall(),
              1e-12);
}

TEST(SurfaceArea, OfACylinderWithoutCapsIsItsWall) {
  const Prism prism{.radius = 0.5, .height = 3.0};
  EXPECT_NEAR(surface_area(test::open_cylinder(0.5, 3.0, 20, 7)), prism.wall(), 1e-12);
}

TEST(SignedVolume, OfACylinderIsThatOfItsPrism) {
  const Prism prism{.radius = 0.5, .height = 3.0};
  EXPECT_NEAR(signed_volume(test::cylinder(0.5, 3.0, 20, 7)), prism.base() * prism.height, 1e-12);
}

TEST(VertexAreas, AddUpToTheSurface) {
  const TriMesh mesh = test::torus(1.0, 0.3, 20, 10);
  const std::vector<double> areas = vertex_areas(mesh);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), surface_area(mesh), 1e-12);
}

TEST(FaceAreas, AreZeroForDegenerateFaces) {
  const TriMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                     .triangles = {{0, 1, 2}, {0, 0, 1}}};
  EXPECT_EQ(face_areas(mesh), (std::vector<double>{0.0, 0.0}));
}

TEST(BoundingBox, OfNothingIsThePointZero) {
  EXPECT_EQ(bounding_box({}).size(), Vec3::Zero());
}

TEST(BoundingBox, HoldsAllPointsTightly) {
  const std::vector<Vec3> points{{1, -2, 3}, {-4, 5, 0}, {0, 0, 7}};
  const Box box = bounding_box(points);
  EXPECT_EQ(box.low, Vec3(-4, -2, 0));
  EXPECT_EQ(box.high, Vec3(1, 5, 7));
  EXPECT_EQ(box.longest_side(), 7.0);
}

TEST(ReferencedPoints, LeaveOutIsolatedVertices) {
  const TriMesh mesh{.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                     .triangles = {{1, 2, 3}}};
  EXPECT_EQ(referenced_points(mesh).size(), 3U);
}

TEST(ReferencedPoints, AreAllPointsOfACloud) {
  EXPECT_EQ(referenced_points({.positions = {{9, 9, 9}, {0, 0, 0}}, .triangles = {}}).size(), 2U);
}

TEST(EnclosingSphere, OfNothingIsAPointAtZero) {
  const Sphere sphere = enclosing_sphere({});
  EXPECT_EQ(sphere.diameter, 0.0);
  EXPECT_EQ(sphere.centre, Vec3::Zero());
}

TEST(EnclosingSphere, OfOnePointHasNoExtent) {
  const std::vector<Vec3> points(5, Vec3(1, 2, 3));
  EXPECT_EQ(enclosing_sphere(points).diameter, 0.0);
  EXPECT_EQ(enclosing_sphere(points).centre, Vec3(1, 2, 3));
}

TEST(EnclosingSphere, OfTwoPointsIsTheirMiddle) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 4, 4}};
  EXPECT_NEAR(enclosing_sphere(points).diameter, 6.0, 6e-12);
  EXPECT_NEAR((enclosing_sphere(points).centre - Vec3(1, 2, 2)).norm(), 0.0, 1e-11);
}

TEST(EnclosingSphere, OfAnObtuseTriangleIsThatOfItsLongestSide) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {2, 0.5, 0}};
  EXPECT_NEAR(enclosing_sphere(points).diameter, 4.0, 4e-12);
}

TEST(EnclosingSphere, OfAnEquilateralTriangleIsItsCircumcircle) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  EXPECT_NEAR(enclosing_sphere(points).diameter, 2.0 / std::sqrt(3.0), 1e-11);
}

TEST(EnclosingSphere, OfARegularTetrahedronPassesThroughItsFourCorners) {
  // Every other corner of a cube of side 2.
  const std::vector<Vec3> points{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_NEAR(enclosing_sphere(points).diameter, 2.0 * std::sqrt(3.0), 1e-11);
  EXPECT_NEAR(enclosing_sphere(points).centre.norm(), 0.0, 1e-11);
}

TEST(EnclosingSphere, OfAFlatTetrahedronIsThatOfItsWidestTriangle) {
  // The tip is so close above the equilateral base that the circumcircle's sphere holds it.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0.5, 0.3, 0.1}};
  EXPECT_NEAR(enclosing_sphere(points).diameter, 2.0 / std::sqrt(3.0), 1e-11);
}

TEST(EnclosingSphere, OfABoxHasItsDiagonalAsDiameter) {
  const Sphere sphere = enclosing_sphere(test::box(1, 2, 3, 4).positions);
  EXPECT_NEAR(sphere.diameter, std::sqrt(1.0 + 4.0 + 9.0), 1e-11);
}

TEST(EnclosingSphere, OfManyCosphericalPointsIsTheirSphere) {
  EXPECT_NEAR(enclosing_sphere(test::sphere(4).positions).diameter, 2.0, 1e-9);
}

TEST(EnclosingSphere, OfCocircularPointsIsTheirCircle) {
  std::vector<Vec3> points;
  points.reserve(360);
  for (int i = 0; i < 360; ++i) {
    points.emplace_back(std::cos(i * pi / 180), std::sin(i * pi / 180), 5.0);
  }
  EXPECT_NEAR(enclosing_sphere(points).diameter, 2.0, 1e-9);
}

TEST(EnclosingSphere, WorksAtExtremeScales) {
  for (const double scale : {1e-150, 1e150}) {
    std::vector<Vec3> points;
    for (const Vec3& p : test::box(1, 2, 3, 2).positions) {
      points.emplace_back(scale * p);
    }
    EXPECT_NEAR(enclosing_sphere(points).diameter / scale, std::sqrt(14.0), 1e-11);
  }
}

}  // namespace
}  // namespace vantage
