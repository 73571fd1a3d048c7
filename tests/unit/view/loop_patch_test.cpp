// SPDX-License-Identifier: MIT
#include "view/loop_patch.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

/// Subdivides the whole triangulation, as the definition says.
DirectionSet eager_subdivision(const DirectionSet& set) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> opposite;
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (const auto& [a, b, c] : set.triangles) {
    opposite[key(a, b)].push_back(c);
    opposite[key(b, c)].push_back(a);
    opposite[key(c, a)].push_back(b);
  }
  DirectionSet finer;
  finer.directions = set.directions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> point;
  for (const auto& [edge, corners] : opposite) {
    point[edge] = static_cast<std::uint32_t>(finer.directions.size());
    const Vec3 sum = 0.375 * (set.directions[edge.first] + set.directions[edge.second]) +
                     0.125 * (set.directions[corners.at(0)] + set.directions[corners.at(1)]);
    finer.directions.push_back(sum.normalized());
  }
  for (const auto& [a, b, c] : set.triangles) {
    const std::uint32_t ab = point[key(a, b)];
    const std::uint32_t bc = point[key(b, c)];
    const std::uint32_t ca = point[key(c, a)];
    finer.triangles.insert(finer.triangles.end(),
                           {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return finer;
}

bool lexicographically_less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The neighbours of a direction of the set, sorted.
std::vector<Vec3> eager_ring(const DirectionSet& set, const Vec3& centre) {
  std::vector<Vec3> ring;
  for (const Triangle& t : set.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (set.directions[t[i]] == centre) {
        ring.push_back(set.directions[t[(i + 1) % 3]]);
      }
    }
  }
  std::sort(ring.begin(), ring.end(), lexicographically_less);
  return ring;
}

/// Walks five levels both ways; `choice` picks the vertex of each ring to move to, or stays.
void expect_equal_rings(const DirectionSet& base, std::uint32_t start, unsigned choice) {
  LoopPatch patch(base, start);
  DirectionSet eager = base;
  Vec3 centre = base.directions[start];
  for (unsigned level = 0; level < 5; ++level) {
    patch.refine();
    eager = eager_subdivision(eager);
    std::vector<Vec3> ring = patch.ring();
    std::vector<Vec3> sorted = ring;
    std::sort(sorted.begin(), sorted.end(), lexicographically_less);
    ASSERT_EQ(sorted, eager_ring(eager, centre)) << "level " << level;
    const std::size_t next = (choice + 3 * level) % (ring.size() + 1);
    if (next < ring.size()) {
      patch.move_to(next);
      centre = ring[next];
    }
  }
}

TEST(LoopPatch, HasTheRingsOfTheWholeSubdivisionOfACube) {
  const DirectionSet cube = direction_set(ViewSphereBase::Cube, 0);
  for (const unsigned choice : {0U, 1U, 2U, 5U}) {
    expect_equal_rings(cube, choice, choice);
  }
}

TEST(LoopPatch, HasTheRingsOfTheWholeSubdivisionOfAnIcosahedron) {
  const DirectionSet icosahedron = direction_set(ViewSphereBase::Icosahedron, 0);
  for (const unsigned choice : {0U, 1U, 3U, 4U}) {
    expect_equal_rings(icosahedron, 2 * choice, choice);
  }
}

TEST(LoopPatch, OfAnIcosahedronKeepsFiveNeighboursWhileItStays) {
  LoopPatch patch(direction_set(ViewSphereBase::Icosahedron, 1), 0);
  for (int level = 0; level < 20; ++level) {
    patch.refine();
    ASSERT_EQ(patch.ring().size(), 5U);
  }
}

}  // namespace
}  // namespace vantage
