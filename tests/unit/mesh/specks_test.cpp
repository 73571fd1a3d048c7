// SPDX-License-Identifier: MIT
#include "mesh/specks.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Adds a triangle with legs of a length, its right angle at the given place.
void add_triangle(TriMesh& mesh, const Vec3& place, double leg) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(place);
  mesh.positions.push_back(place + leg * Vec3::UnitX());
  mesh.positions.push_back(place + leg * Vec3::UnitY());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TEST(FindSpecks, CountsSmallComponentsThatReachOutOfTheOthersBox) {
  TriMesh mesh = test::box(1.0, 1.0, 1.0, 1);
  const Box box = bounding_box(mesh.positions);
  add_triangle(mesh, box.high + Vec3::Ones(), 0.01);
  add_triangle(mesh, box.low - 2.0 * Vec3::Ones(), 0.01);
  add_triangle(mesh, 0.5 * (box.low + box.high), 0.01);  // inside
  mesh.positions.push_back(100.0 * Vec3::Ones());        // of no face
  const Specks specks = find_specks(mesh);
  EXPECT_EQ(specks.count, 2U);
  EXPECT_NEAR(specks.enlargement, std::hypot(4.01, 4.01, 4.0) / std::sqrt(3.0), 1e-12);
}

TEST(FindSpecks, AreNoneOfOneComponentNorOfEqualOnes) {
  EXPECT_EQ(find_specks(test::sphere(2)).count, 0U);
  TriMesh leaves;
  for (int i = 0; i < 50; ++i) {  // each holds 2 % of the surface
    add_triangle(leaves, Vec3(10.0 * i, 0.0, 0.0), 1.0);
  }
  const Specks specks = find_specks(leaves);
  EXPECT_EQ(specks.count, 0U);
  EXPECT_EQ(specks.enlargement, 1.0);
}

}  // namespace
}  // namespace vantage
