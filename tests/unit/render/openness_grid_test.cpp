// SPDX-License-Identifier: MIT
#include "render/openness_grid.h"

#include <cmath>

#include <gtest/gtest.h>

namespace vantage {
namespace {

constexpr int kGridSide = 36;

/// A flat patch seen straight on, one unit a pixel.
FragmentRows flat(int first_row = 0, int rows = kGridSide) {
  FragmentRows patch(kGridSide, first_row, rows, 1);
  for (int y = first_row; y < first_row + rows; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      Fragment& fragment = patch.fragments[patch.index(x, y)];
      fragment.place.position = Vec3f(static_cast<float>(x), static_cast<float>(-y), 0.0F);
      fragment.hit = true;
    }
  }
  return patch;
}

/// Openness 0 where `dark` says so of a place, else 1.
template <class Dark>
OpennessGrid grid_of(const FragmentRows& rows, const Dark& dark) {
  return {rows,
          1.0,
          [&](const SurfacePlace& place, std::size_t) { return dark(place) ? 0.0F : 1.0F; },
          {}};
}

float at(const OpennessGrid& grid, const FragmentRows& rows, int x, int y) {
  return grid.at(rows.at(x, y).place, x, y).value();
}

TEST(OpennessGrid, LeavesAnOpenSurfaceExactlyOpen) {
  const FragmentRows rows = flat();
  const OpennessGrid grid = grid_of(rows, [](const SurfacePlace&) { return false; });
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      ASSERT_EQ(at(grid, rows, x, y), 1.0F);
    }
  }
}

TEST(OpennessGrid, SpreadsOneDarkProbeOverNineAndMixesBetweenThem) {
  const FragmentRows rows = flat();
  const OpennessGrid grid = grid_of(rows, [](const SurfacePlace& place) {
    return place.position.x() == 18.0F && place.position.y() == -18.0F;
  });
  const float ninth = 1.0F / 9.0F;
  EXPECT_FLOAT_EQ(at(grid, rows, 18, 18), 1.0F - ninth);
  EXPECT_FLOAT_EQ(at(grid, rows, 20, 16), 1.0F - ninth);
  EXPECT_FLOAT_EQ(at(grid, rows, 21, 18), 1.0F - 0.5F * ninth);  // half way to the next probe
  EXPECT_EQ(at(grid, rows, 22, 18), 1.0F);
}

TEST(OpennessGrid, NineNeighboursHaveAllSetsOfRays) {
  const FragmentRows rows = flat();
  const OpennessGrid grid(
      rows, 1.0,
      [](const SurfacePlace&, std::size_t set) { return static_cast<float>(set) / 8.0F; }, {});
  for (int x = 2; x < kGridSide - 4; ++x) {
    ASSERT_FLOAT_EQ(at(grid, rows, x, 17), 0.5F);  // mean of 0/8, 1/8, …, 8/8
  }
}

TEST(OpennessGrid, DoesNotReachAcrossAStep) {
  FragmentRows rows = flat();
  for (int y = 0; y < kGridSide; ++y) {
    for (int x = 16; x < kGridSide; ++x) {
      rows.fragments[rows.index(x, y)].place.position.z() = 3.0F;
    }
  }
  const OpennessGrid grid =
      grid_of(rows, [](const SurfacePlace& place) { return place.position.z() == 3.0F; });
  EXPECT_EQ(at(grid, rows, 15, 12), 1.0F);
  EXPECT_EQ(at(grid, rows, 16, 12), 0.0F);
}

TEST(OpennessGrid, DoesNotReachRoundACorner) {
  FragmentRows rows = flat();
  rows.fragments[rows.index(18, 18)].place.normal = Vec3f::UnitX();
  const OpennessGrid grid = grid_of(
      rows, [](const SurfacePlace& place) { return place.normal.isApprox(Vec3f::UnitX()); });
  EXPECT_EQ(at(grid, rows, 16, 18), 1.0F);
  EXPECT_EQ(at(grid, rows, 17, 18), 1.0F);
}

TEST(OpennessGrid, KnowsNothingOfAPatchThatNoProbeShows) {
  const FragmentRows rows = flat();
  const OpennessGrid grid = grid_of(rows, [](const SurfacePlace&) { return false; });
  SurfacePlace far = rows.at(18, 18).place;
  far.position.z() = 5.0F;
  EXPECT_FALSE(grid.at(far, 18, 18).has_value());
}

TEST(OpennessGrid, DoesNotDependOnHowThePictureIsCut) {
  const auto dark = [](const SurfacePlace& place) {
    return std::fmod(7.0F * place.position.x() - 3.0F * place.position.y(), 5.0F) < 2.0F;
  };
  const FragmentRows whole = flat();
  const FragmentRows part = flat(10 - OpennessGrid::kHalo, 5 + 2 * OpennessGrid::kHalo);
  const OpennessGrid of_whole = grid_of(whole, dark);
  const OpennessGrid of_part = grid_of(part, dark);
  for (int y = 10; y < 15; ++y) {
    for (int x = 0; x < kGridSide; ++x) {
      ASSERT_EQ(at(of_part, part, x, y), at(of_whole, whole, x, y)) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace vantage
