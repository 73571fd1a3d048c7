// SPDX-License-Identifier: MIT
#include "view/compact_surface.h"

#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

/// A triangle of vertices 1, 2, 3 among six points.
TriMesh triangle() {
  TriMesh mesh;
  for (int i = 0; i < 6; ++i) {
    mesh.positions.emplace_back(i, i * i, 0.0);
  }
  mesh.triangles = {{1, 2, 3}};
  return mesh;
}

TEST(CompactSurface, LeavesOutWhatNoFaceNames) {
  const CompactSurface compact = compact_surface(triangle(), {FaceSides::Front});
  EXPECT_EQ(compact.vertex_of_row, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(compact.mesh.positions.front(), Vec3(1.0, 1.0, 0.0));
  EXPECT_EQ(compact.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(CompactSurface, LeavesOutFacesThatNameAVertexTwiceWhereverTheyDo) {
  for (const Triangle& broken : {Triangle{4, 4, 5}, Triangle{4, 5, 5}, Triangle{4, 5, 4}}) {
    TriMesh mesh = triangle();
    mesh.triangles.push_back(broken);
    const CompactSurface compact = compact_surface(mesh, {FaceSides::Front});
    EXPECT_EQ(compact.mesh.triangles.size(), 1U);
    EXPECT_EQ(compact.vertex_of_row.size(), 3U);
  }
}

TEST(CompactSurface, KeepsTheSidesOfTheComponentsThatAreLeft) {
  // Components by their lowest vertex: the point 0, the broken face at 1, and two triangles.
  TriMesh mesh;
  for (int i = 0; i < 9; ++i) {
    mesh.positions.emplace_back(i, i * i, 0.0);
  }
  mesh.triangles = {{1, 2, 2}, {3, 4, 5}, {6, 7, 8}};
  const CompactSurface compact =
      compact_surface(mesh, {FaceSides::Both, FaceSides::Both, FaceSides::Front, FaceSides::Both});
  EXPECT_EQ(compact.sides, (std::vector<FaceSides>{FaceSides::Front, FaceSides::Both}));
}

}  // namespace
}  // namespace vantage
