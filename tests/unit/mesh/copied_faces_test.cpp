// SPDX-License-Identifier: MIT
#include "mesh/copied_faces.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

TEST(CopiedFaces, AreThoseBeyondAsManyAsAreLookedAt) {
  TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 0, 1}}, {}};
  for (std::size_t i = 0; i < kMostCopies; ++i) {
    mesh.triangles.push_back({0, 1, 2});
    mesh.triangles.push_back({0, 1, 4});
  }
  EXPECT_TRUE(faces_beyond_copies(mesh).empty());
  const auto next = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.triangles.push_back({2, 1, 0});
  mesh.triangles.push_back({1, 4, 2});
  mesh.triangles.push_back({1, 2, 3});  // another vertex in the same place
  EXPECT_EQ(faces_beyond_copies(mesh), (std::vector<std::uint32_t>{next, next + 2}));
}

TEST(CopiedFaces, AreNoneInAModelWithoutCopies) {
  EXPECT_TRUE(faces_beyond_copies(test::box(1.0, 2.0, 3.0, 40)).empty());
  EXPECT_TRUE(faces_beyond_copies({}).empty());
}

TriMesh with_other_sides(TriMesh mesh) {
  const std::vector<Triangle> faces = mesh.triangles;
  for (const auto& [a, b, c] : faces) {
    mesh.triangles.push_back({b, a, c});
  }
  return mesh;
}

TEST(LeaveOutCopies, KeepsTheFirstFaceOfAPlace) {
  for (const TriMesh& once : {test::sheet(1.0, 1.0, 2), test::box(1.0, 1.0, 1.0, 2)}) {
    TriMesh mesh = with_other_sides(once);
    EXPECT_EQ(leave_out_copies(mesh), once.triangles.size());
    EXPECT_EQ(mesh.triangles, once.triangles);
    EXPECT_EQ(leave_out_copies(mesh), 0U);
    EXPECT_EQ(mesh.triangles, once.triangles);
    mesh.triangles.push_back({mesh.triangles[1][1], mesh.triangles[1][2], mesh.triangles[1][0]});
    EXPECT_EQ(leave_out_copies(mesh), 1U);
    EXPECT_EQ(mesh.triangles, once.triangles);
  }
}

TEST(LeaveOutCopies, KeepsTheWallOfTwoCells) {
  // Two tetrahedra on one triangle, each closed by its own face there.
  TriMesh cells{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 2}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}};
  const std::vector<Triangle> all = cells.triangles;
  EXPECT_EQ(leave_out_copies(cells), 0U);
  EXPECT_EQ(cells.triangles, all);
}

}  // namespace
}  // namespace vantage
