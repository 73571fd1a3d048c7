// SPDX-License-Identifier: MIT
#include "contraction/refinement.h"

#include <string>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

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
  for (const Vec3& p : all->mesh.positions) {
    of_large += p.y() > 3.0 ? 1 : 0;
  }
  EXPECT_EQ(of_large, alone->mesh.positions.size());
  EXPECT_LT(all->mesh.positions.size(), 60'000U);
}

TEST(RefineCoarseComponents, MakesNoMoreOfSliversSideBySide) {
  const TriMesh cylinder = test::cylinder(0.3, 2.0, 2000, 1);  // as many edges from end to end
  const auto fine = refine_coarse_components(cylinder, {});
  ASSERT_TRUE(fine.has_value());
  EXPECT_GT(fine->mesh.positions.size(), cylinder.positions.size());
  EXPECT_LE(fine->mesh.positions.size(), cylinder.positions.size() + 150'000U);
  EXPECT_LE(refine_whole(cylinder, {}).positions.size(), cylinder.positions.size() + 150'000U);
}

TEST(RefineCoarseComponents, TellsHowManyAnEvenMeshOfSliversNeeds) {
  const TriMesh cylinder = test::cylinder(0.3, 2.0, 400, 1);
  const TriMesh mesh = test::together(cylinder, test::box(1.0, 1.0, 1.0, 1), Vec3(0.0, 5.0, 0.0));
  const auto fine = refine_coarse_components(mesh, {});
  ASSERT_TRUE(fine.has_value());
  ASSERT_EQ(fine->even_size.size(), mesh.positions.size());
  EXPECT_GE(fine->even_size.front(), 500U);
  EXPECT_LT(fine->even_size.front(), fine->mesh.positions.size() / 8);
  EXPECT_EQ(fine->even_size.back(), 0U);  // a cube's faces are not thin
}

TEST(RefineCoarseComponents, SliversAreContractedByAnEvenMesh) {
  const auto components = contract(test::cylinder(0.3, 2.0, 400, 1)).components;
  ASSERT_EQ(components.size(), 1U);
  EXPECT_TRUE(components[0].strategy.starts_with("refined ")) << components[0].strategy;
  EXPECT_NE(components[0].strategy.find(", proxy "), std::string::npos) << components[0].strategy;
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
  EXPECT_LT(coarse->mesh.positions.size(), 8 * alone->mesh.positions.size());
  EXPECT_EQ(coarse->mesh.positions.size(), finer->mesh.positions.size());
}

TEST(RefineCoarseComponents, VerticesWithoutAFaceChangeNothing) {
  TriMesh mesh =
      test::together(test::box(1.0, 1.0, 1.0, 1), test::box(0.1, 0.1, 0.1, 1), Vec3(0.0, 5.0, 0.0));
  const auto before = refine_coarse_components(mesh, {});
  mesh.positions.emplace_back(1.0, 0.5, 0.5);
  const auto after = refine_coarse_components(mesh, {});
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->mesh.positions.size(), before->mesh.positions.size() + 1);
}

}  // namespace
}  // namespace vantage
