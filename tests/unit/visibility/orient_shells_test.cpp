// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// A ball of radius `size`, around the origin.
TriMesh ball(double size) {
  return test::moved(test::sphere(2), size, 0.0, Vec3::UnitX(), Vec3::Zero());
}

std::size_t count(const OrientedMesh& oriented, FaceSides sides) {
  return static_cast<std::size_t>(std::count(oriented.sides.begin(), oriented.sides.end(), sides));
}

TEST(OrientShells, LeavesAnOutwardShellAlone) {
  const TriMesh mesh = test::torus(1.0, 0.3, 20, 10);
  const OrientedMesh oriented = orient_shells(mesh);
  EXPECT_EQ(oriented.turned_shells, 0U);
  EXPECT_EQ(oriented.mesh.triangles, mesh.triangles);
  EXPECT_EQ(oriented.sides, std::vector{FaceSides::Front});
}

TEST(OrientShells, TurnsAShellThatIsInsideOut) {
  const OrientedMesh oriented = orient_shells(test::inside_out(test::torus(1.0, 0.3, 20, 10)));
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_GT(signed_volume(oriented.mesh), 0.0);
}

TEST(OrientShells, TurnsItWhereverAVertexLiesThatNoFaceNames) {
  TriMesh mesh = test::inside_out(test::torus(1.0, 0.3, 20, 10));
  mesh.positions.emplace_back(1e17, 0.0, 0.0);
  EXPECT_EQ(orient_shells(mesh).turned_shells, 1U);
}

TEST(OrientShells, KeepsACavity) {
  const TriMesh hollow = test::together(ball(1.0), test::inside_out(ball(0.5)), Vec3::Zero());
  EXPECT_EQ(orient_shells(hollow).turned_shells, 0U);
}

TEST(OrientShells, TurnsACavityThatIsWoundOutwards) {
  const TriMesh wrong = test::together(ball(1.0), ball(0.5), Vec3::Zero());
  const TriMesh right = test::together(ball(1.0), test::inside_out(ball(0.5)), Vec3::Zero());
  const OrientedMesh oriented = orient_shells(wrong);
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_DOUBLE_EQ(signed_volume(oriented.mesh), signed_volume(right));
}

TEST(OrientShells, AlternatesOverThreeNestedShells) {
  const TriMesh inner = test::together(ball(1.0), ball(0.6), Vec3::Zero());
  const TriMesh nested = test::together(inner, ball(0.3), Vec3::Zero());
  // Depths 0, 1, 2: only the middle one is turned.
  const OrientedMesh oriented = orient_shells(nested);
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_NEAR(signed_volume(oriented.mesh) / signed_volume(ball(1.0)),
              1.0 - 0.6 * 0.6 * 0.6 + 0.3 * 0.3 * 0.3, 1e-12);
}

TEST(OrientShells, TurnsOneOfTwoShellsSideBySide) {
  const TriMesh two = test::together(ball(1.0), test::inside_out(ball(1.0)), Vec3(3.0, 0.0, 0.0));
  const OrientedMesh oriented = orient_shells(two);
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_NEAR(signed_volume(oriented.mesh), 2.0 * signed_volume(ball(1.0)), 1e-12);
}

TEST(OrientShells, LeavesShellsThatReachThroughEachOtherAlone) {
  for (const double apart :
       {0.75, 0.85, 0.95, 1.05, 1.2}) {  // of the small one little to half is outside
    const TriMesh two = test::together(ball(1.0), ball(0.3), Vec3(apart, 0.0, 0.0));
    EXPECT_EQ(orient_shells(two).turned_shells, 0U) << apart;
    const TriMesh wrong =
        test::together(ball(1.0), test::inside_out(ball(0.3)), Vec3(apart, 0.0, 0.0));
    EXPECT_EQ(orient_shells(wrong).turned_shells, 1U) << apart;
  }
}

TEST(OrientShells, GivesOpenSurfacesBothSides) {
  const TriMesh mesh = test::open_cylinder(1.0, 2.0, 12, 3);
  const OrientedMesh oriented = orient_shells(mesh);
  EXPECT_EQ(oriented.sides, std::vector{FaceSides::Both});
  EXPECT_EQ(oriented.turned_shells, 0U);
}

TEST(OrientShells, GivesInconsistentWindingBothSides) {
  TriMesh mesh = test::sphere(1);
  std::swap(mesh.triangles[7][1], mesh.triangles[7][2]);
  EXPECT_EQ(orient_shells(mesh).sides, std::vector{FaceSides::Both});
}

TEST(OrientShells, SeesThroughDuplicatedVertices) {
  const OrientedMesh oriented = orient_shells(test::inside_out(test::soup(test::sphere(1))));
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_EQ(count(oriented, FaceSides::Front), oriented.sides.size());
}

TEST(OrientShells, KeepsCubesThatShareAnEdgeApart) {
  // The second cube, inside out, touches the first along one edge.
  const TriMesh cubes =
      test::together(test::box(1, 1, 1, 1), test::inside_out(test::box(1, 1, 1, 1)), Vec3(1, 1, 0));
  const OrientedMesh oriented = orient_shells(cubes);
  EXPECT_EQ(oriented.turned_shells, 1U);
  EXPECT_NEAR(signed_volume(oriented.mesh), 2.0, 1e-12);
}

/// The halves of an octahedron need each other to be closed; a small body at each edge between them does not,
/// whichever edge comes first.
TEST(OrientShells, JoinsOnlyWhatIsOpenByItself) {
  TriMesh mesh{.positions = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0),
                             Vec3(0, 0, 1), Vec3(0, 0, -1)},
               .triangles = {}};
  for (std::uint32_t a = 0; a < 4; ++a) {
    const std::uint32_t b = (a + 1) % 4;
    mesh.triangles.push_back({a, b, 4});
    mesh.triangles.push_back({b, a, 5});
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 out = 0.7 * (mesh.positions[a] + mesh.positions[b]);
    mesh.positions.insert(mesh.positions.end(),
                          {out + Vec3(0.0, 0.0, 0.2), out - Vec3(0.0, 0.0, 0.2)});
    for (const Triangle& t :
         {Triangle{a, n, b}, Triangle{b, n, n + 1}, Triangle{b, n + 1, a}, Triangle{a, n + 1, n}}) {
      mesh.triangles.push_back({t[0], t[2], t[1]});  // inside out
    }
  }
  for (unsigned seed = 0; seed < 8; ++seed) {
    const OrientedMesh oriented = orient_shells(test::renumbered(mesh, seed));
    EXPECT_EQ(oriented.turned_shells, 4U) << seed;
    EXPECT_EQ(count(oriented, FaceSides::Front), oriented.sides.size()) << seed;
  }
}

TEST(OrientShells, LeavesAFlatClosedShellAlone) {
  TriMesh pillow = test::sheet(1.0, 1.0, 2);
  const TriMesh back = test::inside_out(pillow);
  pillow.triangles.insert(pillow.triangles.end(), back.triangles.begin(), back.triangles.end());
  const OrientedMesh oriented = orient_shells(pillow);
  EXPECT_EQ(oriented.turned_shells, 0U);
  EXPECT_EQ(oriented.sides, std::vector{FaceSides::Front});
}

TEST(OrientShells, OfAnEmptyMeshIsEmpty) {
  EXPECT_TRUE(orient_shells(TriMesh{}).sides.empty());
}

}  // namespace
}  // namespace vantage
