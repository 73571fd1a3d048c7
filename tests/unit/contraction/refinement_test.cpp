// SPDX-License-Identifier: MIT
#include "contraction/refinement.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

/// A cube and a row of many smaller ones, all coarse; the large one is the last.
TriMesh cube_after_many() {
  TriMesh small = test::box(0.1, 0.1, 0.1, 1);
  TriMesh row = small;
  for (int i = 1; i < 40; ++i) {
    row = test::together(row, small, Vec3(0.2 * i, 0.0, 0.0));
  }
  return test::together(row, test::box(1.0, 1.0, 1.0, 1), Vec3(0.0, 5.0, 0.0));
}

TEST(RefineCoarseComponents, RefinesTheLargestFirstAndNotTooMany) {
  const TriMesh cube = test::box(1.0, 1.0, 1.0, 1);
  const auto alone = refine_coarse_components(cube, {});
  const auto all = refine_coarse_components(cube_after_many(), {});
  ASSERT_TRUE(alone && all);
  std::size_t of_large = 0;
  for (const Vec3& p : all->positions) {
    of_large += p.y() > 3.0 ? 1 : 0;
  }
  EXPECT_EQ(of_large, alone->positions.size());
  EXPECT_LT(all->positions.size(), 60'000U);
}

TEST(RefineCoarseComponents, MakesNoMoreOfSliversSideBySide) {
  const TriMesh cylinder = test::cylinder(0.3, 2.0, 2000, 1);  // as many edges from end to end
  const auto fine = refine_coarse_components(cylinder, {});
  ASSERT_TRUE(fine.has_value());
  EXPECT_GT(fine->positions.size(), cylinder.positions.size());
  EXPECT_LE(fine->positions.size(), cylinder.positions.size() + 150'000U);
  EXPECT_LE(refine_whole(cylinder, {}).positions.size(), cylinder.positions.size() + 150'000U);
}

/// Eight cubes, which alone would be given twice as many vertices as they may have together.
TriMesh eight_cubes(int cells) {
  TriMesh row = test::box(1.0, 1.0, 1.0, cells);
  for (int i = 1; i < 8; ++i) {
    row = test::together(row, test::box(1.0, 1.0, 1.0, cells), Vec3(2.0 * i, 0.0, 0.0));
  }
  return row;
}

TEST(RefineCoarseComponents, SharesVerticesByTheSurfaceNotByItsTriangles) {
  const auto alone = refine_coarse_components(test::box(1.0, 1.0, 1.0, 1), {});
  const auto coarse = refine_coarse_components(eight_cubes(1), {});
  const auto finer = refine_coarse_components(eight_cubes(8), {});
  ASSERT_TRUE(alone && coarse && finer);
  EXPECT_LT(coarse->positions.size(), 8 * alone->positions.size());
  EXPECT_EQ(coarse->positions.size(), finer->positions.size());
}

TEST(RefineCoarseComponents, VerticesWithoutAFaceChangeNothing) {
  TriMesh mesh =
      test::together(test::box(1.0, 1.0, 1.0, 1), test::box(0.1, 0.1, 0.1, 1), Vec3(0.0, 5.0, 0.0));
  const auto before = refine_coarse_components(mesh, {});
  mesh.positions.emplace_back(1.0, 0.5, 0.5);
  const auto after = refine_coarse_components(mesh, {});
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->positions.size(), before->positions.size() + 1);
}

}  // namespace
}  // namespace vantage
