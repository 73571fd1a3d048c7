// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/channel.h"
#include "vantage/view/scoring.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Views in a row, each beside the ones before and after it.
IndexLists row_of(std::uint32_t count) {
  IndexLists next;
  for (std::uint32_t v = 0; v < count; ++v) {
    if (v > 0) {
      next.values.push_back(v - 1);
    }
    if (v + 1 < count) {
      next.values.push_back(v + 1);
    }
    next.offsets.push_back(static_cast<std::uint32_t>(next.values.size()));
  }
  return next;
}

/// Two faces of area 1.
std::vector<FaceArea> two(std::uint32_t first) {
  return {{first, 1.0F}, {first + 1, 1.0F}};
}

TEST(Exploration, GoesToWhatIsNewAndPastWhatIsNot) {
  // Both ends show as much that is new, two steps away; the lower index comes first.
  const ViewChannel channel{6, {two(4), two(0), two(0), two(0), two(2)}};
  const Exploration way = explore_by_entropy(channel, row_of(5), 2, 1.0);
  EXPECT_EQ(way.views, (std::vector<std::uint32_t>{2, 1, 0, 1, 2, 3, 4}));
  EXPECT_DOUBLE_EQ(way.coverage, 1.0);
}

TEST(Exploration, TakesTheGreaterEntropyFirst) {
  const ViewChannel channel{
      6, {{{0, 3.0F}, {1, 1.0F}}, two(2), {{2, 1.0F}, {3, 1.0F}, {4, 1.0F}, {5, 1.0F}}}};
  // 0.81 bits on the left, 1 of two bits on the right, whose other half is seen already.
  EXPECT_EQ(explore_by_entropy(channel, row_of(3), 1, 1.0).views,
            (std::vector<std::uint32_t>{1, 2, 1, 0}));
}

TEST(Exploration, EndsWhereEnoughIsSeen) {
  const ViewChannel channel{8, {two(0), two(2), two(4), two(6)}};
  const Exploration way = explore_by_entropy(channel, row_of(4), 0, 0.5);
  EXPECT_EQ(way.views, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_DOUBLE_EQ(way.coverage, 0.5);
  EXPECT_EQ(explore_by_entropy(channel, row_of(4), 3, 0.0).views, (std::vector<std::uint32_t>{3}));
}

TEST(Exploration, EndsWhereNothingNewCanBeReached) {
  ViewChannel channel{4, {two(0), two(0), {}}};
  const Exploration alone = explore_by_entropy(channel, row_of(3), 0, 1.0);
  EXPECT_EQ(alone.views.size(), 1U);
  EXPECT_DOUBLE_EQ(alone.coverage, 1.0);
  channel.views[2] = {{2, 1.0F}};  // one face, a certainty: no entropy
  EXPECT_LT(explore_by_entropy(channel, row_of(3), 0, 1.0).coverage, 1.0);
}

TEST(Exploration, RefusesWhatDoesNotBelongTogether) {
  const ViewChannel channel{2, {two(0), two(0)}};
  EXPECT_THROW(explore_by_entropy(channel, row_of(3), 0, 1.0), InvalidInput);
  EXPECT_THROW(explore_by_entropy(channel, row_of(2), 2, 1.0), InvalidInput);
  EXPECT_THROW(explore_by_entropy(channel, row_of(2), 0, 1.5), InvalidInput);
  const ViewChannel broken{1, {two(0), two(0)}};
  EXPECT_THROW(explore_by_entropy(broken, row_of(2), 0, 1.0), InvalidInput);
  const ViewChannel descending{2, {{{1, 1.0F}, {0, 1.0F}}, {{0, 1.0F}}}};
  EXPECT_THROW(explore_by_entropy(descending, row_of(2), 0, 1.0), InvalidInput);
}

TEST(Exploration, OfARingStepsBetweenNeighboursUntilTheShareIsSeenAndNotFurther) {
  const TriMesh ring = test::torus(1.0, 0.4, 24, 12);
  const std::vector<FaceSides> sides{FaceSides::Front};
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 2);
  const ScoringCamera camera{.sphere = enclosing_sphere(ring.positions)};
  std::vector<Viewpoint> eyes;
  for (const Vec3& d : set.directions) {
    eyes.push_back(camera.viewpoint(d));
  }
  const ViewChannel channel = channel_table(FaceVisibility(ring, sides), eyes);
  const IndexLists next = vertex_neighbours({set.directions, set.triangles});
  const Exploration way = explore_by_entropy(channel, next, 5, 0.98);
  EXPECT_GE(way.coverage, 0.98);
  EXPECT_EQ(way.views.front(), 5U);
  for (std::size_t i = 1; i < way.views.size(); ++i) {
    const auto beside = next[way.views[i - 1]];
    EXPECT_EQ(std::count(beside.begin(), beside.end(), way.views[i]), 1) << i;
  }
  // A way that sees less is the beginning of one that sees more.
  const Exploration shorter = explore_by_entropy(channel, next, 5, 0.8);
  EXPECT_LT(shorter.views.size(), way.views.size());
  EXPECT_TRUE(std::equal(shorter.views.begin(), shorter.views.end(), way.views.begin()));
}

}  // namespace
}  // namespace vantage
