// SPDX-License-Identifier: MIT
#include "spatial/close_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "support/shapes.h"

namespace vantage {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_of(const TriMesh& mesh) {
  Pairs pairs;
  const bool complete =
      for_each_close_pair(mesh, 10'000'000, [&](std::uint32_t f, std::uint32_t g) {
        EXPECT_LT(f, g);
        EXPECT_TRUE(pairs.emplace(f, g).second) << "twice";
      });
  EXPECT_TRUE(complete);
  return pairs;
}

/// How far two boxes are apart along some axis; below 0 if they overlap.
double gap_between(const Box& one, const Box& other) {
  double gap = -1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    gap = std::max({gap, other.low[axis] - one.high[axis], one.low[axis] - other.high[axis]});
  }
  return gap;
}

/// Pairs that are wrongly among those found, or missing.
std::size_t mistakes_in(const TriMesh& mesh, const Pairs& found) {
  constexpr double kNearly = 1e-6;  // some roundings to float
  std::vector<Box> boxes;
  for (const auto& [a, b, c] : mesh.triangles) {
    boxes.push_back(
        bounding_box(std::array{mesh.positions[a], mesh.positions[b], mesh.positions[c]}));
  }
  std::size_t mistakes = 0;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::uint32_t g = f + 1; g < mesh.triangles.size(); ++g) {
      const double gap = gap_between(boxes[f], boxes[g]);
      const bool is_found = found.contains({f, g});
      mistakes += is_found ? (gap > kNearly ? 1 : 0) : (gap <= 0.0 ? 1 : 0);
    }
  }
  return mistakes;
}

TEST(CloseFaces, AreAllPairsWhoseBoxesOverlap) {
  for (const TriMesh& mesh :
       {test::torus(1.0, 0.3, 23, 11), test::soup(test::sphere(2)), test::box(1.0, 2.0, 3.0, 4),
        test::together(test::sphere(1), test::sphere(2), Vec3(0.5, 0.0, 0.0))}) {
    const Pairs found = pairs_of(mesh);
    EXPECT_GT(found.size(), mesh.triangles.size());
    EXPECT_EQ(mistakes_in(mesh, found), 0U);
  }
}

TEST(CloseFaces, OfNextToNothingAreNone) {
  EXPECT_TRUE(pairs_of({}).empty());
  EXPECT_TRUE(pairs_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).empty());
}

TEST(CloseFaces, EndWhereThereAreTooMany) {
  const TriMesh mesh = test::sphere(3);
  const std::size_t all = pairs_of(mesh).size();
  std::size_t visited = 0;
  const auto count = [&](std::uint32_t, std::uint32_t) { ++visited; };
  EXPECT_FALSE(for_each_close_pair(mesh, 0, count));
  EXPECT_EQ(visited, 0U);
  EXPECT_FALSE(for_each_close_pair(mesh, all, count));
  EXPECT_LT(visited, all);
  visited = 0;
  EXPECT_TRUE(for_each_close_pair(mesh, 40 * mesh.triangles.size(), count));
  EXPECT_EQ(visited, all);
}

}  // namespace
}  // namespace vantage
