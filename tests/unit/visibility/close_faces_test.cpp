// SPDX-License-Identifier: MIT
#include "visibility/close_faces.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Surface surface_of(const TriMesh& mesh) {
  const std::vector<FaceSides> sides{FaceSides::Front};
  return prepare_surface(mesh, sides);
}

Pairs pairs_of(const Surface& surface) {
  Pairs pairs;
  const bool complete =
      for_each_close_pair(surface, 10'000'000, [&](std::uint32_t f, std::uint32_t g) {
        EXPECT_LT(f, g);
        EXPECT_TRUE(pairs.emplace(f, g).second) << "twice";
      });
  EXPECT_TRUE(complete);
  return pairs;
}

/// How far the boxes of two faces are apart along some axis; below 0 if they overlap.
double gap_between(const Surface& surface, std::uint32_t f, std::uint32_t g) {
  double gap = -1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto span_of = [&](std::uint32_t face) {
      const auto& [a, b, c] = surface.faces[face];
      return std::minmax({surface.sites[a][axis], surface.sites[b][axis], surface.sites[c][axis]});
    };
    const auto [low, high] = span_of(f);
    const auto [other_low, other_high] = span_of(g);
    gap = std::max({gap, other_low - high, low - other_high});
  }
  return gap;
}

/// Pairs that are wrongly among those found, or missing.
std::size_t mistakes_in(const Surface& surface, const Pairs& found) {
  constexpr double kNearly = 1e-6;  // some roundings to float
  std::size_t mistakes = 0;
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    for (std::uint32_t g = f + 1; g < surface.faces.size(); ++g) {
      const double gap = gap_between(surface, f, g);
      const bool is_found = found.contains({f, g});
      mistakes += is_found ? (gap > kNearly ? 1 : 0) : (gap <= 0.0 ? 1 : 0);
    }
  }
  return mistakes;
}

TEST(CloseFaces, AreAllPairsWhoseBoxesOverlap) {
  for (const TriMesh& mesh :
       {test::torus(1.0, 0.3, 23, 11), test::soup(test::sphere(2)), test::box(1.0, 2.0, 3.0, 4),
        test::together(test::sphere(2), test::sphere(3), Vec3(0.5, 0.0, 0.0))}) {
    const Surface surface = surface_of(mesh);
    const Pairs found = pairs_of(surface);
    EXPECT_GT(found.size(), surface.faces.size());
    EXPECT_EQ(mistakes_in(surface, found), 0U);
  }
}

TEST(CloseFaces, OfNextToNothingAreNone) {
  EXPECT_TRUE(pairs_of(surface_of({})).empty());
  EXPECT_TRUE(pairs_of(surface_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}})).empty());
}

TEST(CloseFaces, EndWhereThereAreTooMany) {
  const Surface surface = surface_of(test::sphere(3));
  const std::size_t all = pairs_of(surface).size();
  std::size_t visited = 0;
  const auto count = [&](std::uint32_t, std::uint32_t) { ++visited; };
  EXPECT_FALSE(for_each_close_pair(surface, 0, count));
  EXPECT_EQ(visited, 0U);
  EXPECT_FALSE(for_each_close_pair(surface, all, count));
  EXPECT_LT(visited, all);
  visited = 0;
  EXPECT_TRUE(for_each_close_pair(surface, 40 * surface.faces.size(), count));
  EXPECT_EQ(visited, all);
}

}  // namespace
}  // namespace vantage
