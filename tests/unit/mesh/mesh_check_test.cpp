// SPDX-License-Identifier: MIT
#include "vantage/mesh/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage::test {
namespace {

/// The tetrahedron 0 a b c, wound outwards.
void add_tetrahedron(TriMesh& mesh, std::array<std::uint32_t, 4> v) {
  mesh.triangles.insert(
      mesh.triangles.end(),
      {{v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[1], v[2], v[3]}, {v[0], v[3], v[2]}});
}

TriMesh tetrahedron() {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  add_tetrahedron(mesh, {0, 1, 2, 3});
  return mesh;
}

TEST(CheckMesh, FindsNothingWrongWithABox) {
  const MeshReport report = check_mesh(box(1, 2, 3, 2));
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.isolated_vertices + report.duplicate_vertices + report.repeated_index_faces +
                report.zero_area_faces + report.duplicate_faces + report.boundary_edges +
                report.non_manifold_edges + report.non_manifold_vertices +
                report.inconsistent_edges,
            0U);
  EXPECT_NEAR(report.signed_volume, 1.0 * 2.0 * 3.0, 1e-14);
}

TEST(CheckMesh, AddsTheGeneraOfAllComponents) {
  EXPECT_EQ(check_mesh(sphere(1)).genus, 0U);
  EXPECT_EQ(check_mesh(torus(2, 0.5, 8, 6)).genus, 1U);
  const TriMesh rings = together(torus(2, 0.5, 8, 6), torus(2, 0.5, 8, 6), Vec3(9, 0, 0));
  EXPECT_EQ(check_mesh(rings).genus, 2U);
  EXPECT_EQ(check_mesh(rings).components, 2U);
}

TEST(CheckMesh, CountsTheTwoBoundaryLoopsOfAnOpenCylinder) {
  const MeshReport report = check_mesh(open_cylinder(1, 2, 12, 3));
  EXPECT_EQ(report.boundary_edges, 24U);
  EXPECT_EQ(report.boundary_loops, 2U);
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.genus.has_value());
}

TEST(CheckMesh, KnowsASurfaceThatIsInsideOut) {
  const MeshReport report = check_mesh(inside_out(box(1, 1, 1, 1)));
  EXPECT_TRUE(report.oriented);
  EXPECT_NEAR(report.signed_volume, -1.0, 1e-14);
}

TEST(CheckMesh, CountsTheEdgesOfAFaceThatIsTurned) {
  TriMesh mesh = box(1, 1, 1, 1);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.inconsistent_edges, 3U);
  EXPECT_FALSE(report.oriented);
  EXPECT_EQ(report.genus, 0U);  // turning a face back does not change the shape
}

TEST(CheckMesh, CountsIsolatedAndDuplicateVertices) {
  TriMesh mesh = tetrahedron();
  mesh.positions.emplace_back(5, 5, 5);
  mesh.positions.emplace_back(0, 0, 0);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.isolated_vertices, 2U);
  EXPECT_EQ(report.duplicate_vertices, 1U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.genus, 0U);
}

TEST(CheckMesh, CountsFacesThatNameAVertexTwiceAsEmpty) {
  TriMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 1, 2});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.repeated_index_faces, 1U);
  EXPECT_EQ(report.zero_area_faces, 1U);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.genus, 0U);
}

TEST(CheckMesh, CountsFacesOfThreePointsOnALineAsEmpty) {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(3, 3, 3), Vec3(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(check_mesh(mesh).zero_area_faces, 1U);
}

TEST(CheckMesh, CountsFacesThatAppearAgainInAnyOrder) {
  TriMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 0, 2});
  mesh.triangles.push_back({2, 1, 0});
  EXPECT_EQ(check_mesh(mesh).duplicate_faces, 2U);
}

TEST(CheckMesh, CountsAsManyRepeatedFacesAsASetOfThemLeavesOut) {
  std::mt19937 random(11);
  const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 5U); };
  for (int round = 0; round < 50; ++round) {
    TriMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
                 .triangles = {}};
    std::set<Triangle> different;
    for (int face = 0; face < 12; ++face) {
      Triangle t{vertex(), vertex(), vertex()};
      mesh.triangles.push_back(t);
      std::sort(t.begin(), t.end());
      different.insert(t);
    }
    EXPECT_EQ(check_mesh(mesh).duplicate_faces, 12U - different.size()) << "round " << round;
  }
}

TEST(CheckMesh, CountsAnEdgeOfFourFacesAsNonManifold) {
  TriMesh mesh = tetrahedron();  // two tetrahedra share the edge 0 1
  mesh.positions.emplace_back(0, -1, 0);
  mesh.positions.emplace_back(0, 0, -1);
  add_tetrahedron(mesh, {0, 1, 4, 5});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1U);
  EXPECT_EQ(report.non_manifold_vertices, 0U);
  EXPECT_FALSE(report.closed);
}

TEST(CheckMesh, CountsAVertexBetweenTwoFansAsNonManifold) {
  TriMesh mesh = tetrahedron();  // two tetrahedra share the vertex 0
  mesh.positions.emplace_back(-1, 0, 0);
  mesh.positions.emplace_back(0, -1, 0);
  mesh.positions.emplace_back(0, 0, -1);
  add_tetrahedron(mesh, {0, 5, 4, 6});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.non_manifold_vertices, 1U);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.genus, 0U);  // two spheres that touch
}

TEST(CheckMesh, GivesNoGenusToAKleinBottle) {
  // A grid of quads glued to a torus, but turned over where the first direction closes.
  constexpr std::uint32_t kAround = 5;
  constexpr std::uint32_t kAlong = 6;
  TriMesh mesh;
  const auto id = [&](std::uint32_t i, std::uint32_t j) {
    return i < kAlong ? i * kAround + j % kAround : (kAround - j % kAround) % kAround;
  };
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      mesh.positions.emplace_back(i, std::cos(1.0 * j), std::sin(1.0 * j));
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.non_manifold_vertices, 0U);
  EXPECT_FALSE(report.genus.has_value());
}

TEST(CheckMesh, TreatsASoupAsOneComponentForEachFace) {
  const MeshReport report = check_mesh(soup(box(1, 1, 1, 1)));
  EXPECT_EQ(report.components, 12U);
  EXPECT_EQ(report.duplicate_vertices, 36U - 8U);
}

TEST(CheckMesh, AcceptsAMeshWithoutFacesOrVertices) {
  const MeshReport report = check_mesh({});
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.oriented);
  EXPECT_EQ(report.components, 0U);
}

}  // namespace
}  // namespace vantage::test
