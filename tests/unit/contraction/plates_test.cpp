// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

#include "contraction/refinement.h"
#include "support/named_mesh.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using test::NamedMesh;

class Plate : public ::testing::TestWithParam<NamedMesh> {};

/// Their rims become lines that held the rest with 0.3 to 0.7 of its area.
TEST_P(Plate, IsContractedToAThinRest) {
  EXPECT_LE(contract(GetParam().mesh).shrinkage.back(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Plates, Plate,
                         ::testing::Values(NamedMesh{"Square", test::box(1.0, 1.0, 0.02, 20)},
                                           NamedMesh{"Thick", test::box(1.0, 1.0, 0.1, 20)},
                                           NamedMesh{"Lath", test::box(1.0, 0.3, 0.02, 10)},
                                           NamedMesh{"OpenSheet", test::sheet(2.0, 1.0, 60)}),
                         [](const auto& instance) { return instance.param.name; });

TEST(Plates, ContractAlikeWhateverTheirMesh) {
  const ContractionHistory history = contract(test::box(1.0, 1.0, 0.02, 40));
  for (const int cells : {4, 20}) {
    const ContractionHistory other = contract(test::box(1.0, 1.0, 0.02, cells));
    ASSERT_EQ(other.shrinkage.size(), history.shrinkage.size()) << cells;
    for (std::size_t j = 0; j < history.shrinkage.size(); ++j) {
      EXPECT_NEAR(other.shrinkage[j], history.shrinkage[j], 0.01) << cells << ", level " << j;
    }
  }
}

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
