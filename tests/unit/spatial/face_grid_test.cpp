// SPDX-License-Identifier: MIT
#include "spatial/face_grid.h"

#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

/// Square sheets of two faces over one another at heights 0, 1, 2, …
TriMesh stack(int sheets) {
  TriMesh mesh = test::sheet(1.0, 1.0, 1);
  const TriMesh one = mesh;
  for (int i = 1; i < sheets; ++i) {
    mesh = test::together(mesh, one, Vec3(0, 0, i));
  }
  return mesh;
}

FaceGrid grid_of_all(const TriMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return {mesh, all, bounding_box(mesh.positions), 2};
}

TEST(FaceGrid, VisitsWhatIsAboveAPointAndNotWhatIsBelow) {
  const TriMesh mesh = stack(100);
  const FaceGrid grid = grid_of_all(mesh);
  std::set<double> heights;
  grid.visit_at(mesh.positions[0] + Vec3(0, 0, 94.5),
                [&](const Triangle& t) { heights.insert(mesh.positions[t[0]].z()); });
  EXPECT_EQ(heights, (std::set<double>{95, 96, 97, 98, 99}));
}

TEST(FaceGrid, AWalkVisitsWhatIsAtItsHeight) {
  const TriMesh mesh = stack(100);
  const FaceGrid grid = grid_of_all(mesh);
  const Box box = bounding_box(mesh.positions);
  std::set<double> heights;
  grid.walk(
      Vec3(box.low.x(), box.low.y(), 40.9), Vec3(box.high.x(), box.high.y(), 43.1),
      [&](const Triangle& t) { heights.insert(mesh.positions[t[0]].z()); },
      [](double) { return false; });
  EXPECT_TRUE(heights.contains(41) && heights.contains(42) && heights.contains(43));
  EXPECT_LE(heights.size(), 9U);  // a segment's box is taken wider by a part of a cell
}

}  // namespace
}  // namespace vantage
