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

}  // namespace
}  // namespace vantage
