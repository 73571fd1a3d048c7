// SPDX-License-Identifier: MIT
#include "render/corner_normals.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

constexpr Crease kCrease{30.0 * std::numbers::pi / 180.0, 50.0 * std::numbers::pi / 180.0};
constexpr double kFloatRounding = 1e-6;

/// Largest deviation of a corner normal from what `expected` gives for face and position.
template <class Expected>
double worst_deviation(const TriMesh& mesh, const Expected& expected) {
  const auto normals = corner_normals(mesh, kCrease);
  double worst = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 normal = normals[f][c].cast<double>();
      worst =
          test::larger(worst, (normal - expected(f, mesh.positions[mesh.triangles[f][c]])).norm());
    }
  }
  return worst;
}

TEST(CornerNormals, OfASpherePointOutwards) {
  // An icosphere of level 3 has edges of about 0.15; normals err by less than their square.
  const TriMesh mesh = test::sphere(3);
  EXPECT_LT(worst_deviation(mesh, [](std::size_t, const Vec3& p) { return p; }), 0.15 * 0.15);
}

TEST(CornerNormals, OfABoxAreThoseOfItsFaces) {
  const TriMesh mesh = test::box(1.0, 2.0, 3.0, 2);
  const auto of_face = [&](std::size_t f, const Vec3&) {
    return Vec3(area_vector(mesh, mesh.triangles[f]).normalized());
  };
  EXPECT_LT(worst_deviation(mesh, of_face), kFloatRounding);
}

TEST(CornerNormals, OfATriangleSoupAreThoseOfTheWeldedSurface) {
  const TriMesh whole = test::sphere(2);
  const TriMesh apart = test::soup(whole);
  const auto expected = corner_normals(whole, kCrease);
  const auto found = corner_normals(apart, kCrease);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t f = 0; f < found.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(found[f][c], expected[f][c]);
    }
  }
}

TEST(CornerNormals, OfFacesWoundBothWaysDifferOnlyInSign) {
  TriMesh mesh = test::sphere(2);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 2) {
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  }
  const auto outward = [](std::size_t f, const Vec3& p) { return Vec3(f % 2 == 0 ? -p : p); };
  EXPECT_LT(worst_deviation(mesh, outward), 0.03);
}

TEST(CornerNormals, AtTheHubOfALargeFanStayThoseOfTheFan) {
  // 200 faces meet at each cap's centre, too many to compare pair by pair.
  const TriMesh mesh = test::cylinder(1.0, 2.0, 200, 1);
  const auto expected = [&](std::size_t f, const Vec3& p) {
    const Vec3 face = area_vector(mesh, mesh.triangles[f]).normalized();
    const bool is_cap = std::abs(face.z()) > 0.5;
    return is_cap ? face : Vec3(Vec3(p.x(), p.y(), 0.0).normalized());
  };
  // Along the rim faces of unequal area left and right lean by less than the 1.8° between them.
  EXPECT_LT(worst_deviation(mesh, expected), 1.8 * std::numbers::pi / 180.0);
}

TEST(CornerNormals, OfAZeroAreaFaceAreZero) {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  mesh.triangles = {{0, 1, 2}};
  const auto normals = corner_normals(mesh, kCrease);
  EXPECT_EQ(normals[0][0].norm(), 0.0F);
}

}  // namespace
}  // namespace vantage
