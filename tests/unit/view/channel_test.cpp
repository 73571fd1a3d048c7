// SPDX-License-Identifier: MIT
#include "vantage/view/channel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "core/random.h"
#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

ViewChannel half_seen_channel(std::size_t views, std::size_t faces, std::uint64_t seed) {
  Pcg32 random(seed);
  ViewChannel channel{faces, {}};
  for (std::size_t v = 0; v < views; ++v) {
    channel.views.emplace_back();
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (random.uniform() < 0.5) {
        channel.views.back().push_back({f, static_cast<float>(0.1 + random.uniform())});
      }
    }
  }
  return channel;
}

/// I(v̂;Z) of merged views by its definition, in a dense table.
double merged_information(const ViewChannel& channel, const std::vector<std::size_t>& merged) {
  std::vector<double> p(channel.face_count, 0.0);
  std::vector<double> q(channel.face_count, 0.0);
  double all = 0.0;
  double some = 0.0;
  for (std::size_t v = 0; v < channel.views.size(); ++v) {
    const bool is_merged = std::find(merged.begin(), merged.end(), v) != merged.end();
    for (const FaceArea& a : channel.views[v]) {
      const auto area = static_cast<double>(a.area);
      p[a.face] += area;
      all += area;
      q[a.face] += is_merged ? area : 0.0;
      some += is_merged ? area : 0.0;
    }
  }
  double sum = 0.0;
  for (std::size_t z = 0; z < p.size(); ++z) {
    sum += q[z] > 0.0 ? q[z] / some * std::log2(q[z] / some / (p[z] / all)) : 0.0;
  }
  return sum;
}

TEST(GreedyEntropyViews, TakesTheViewOfMostEntropyFirst) {
  // One face: 0 bits. Two equal faces: 1 bit. Four equal faces: 2 bits.
  const ViewChannel channel{
      7, {{{0, 1.0F}}, {{1, 1.0F}, {2, 1.0F}}, {{3, 1.0F}, {4, 1.0F}, {5, 1.0F}, {6, 1.0F}}}};
  const auto picks = greedy_entropy_views(channel, 1);
  ASSERT_EQ(picks.size(), 1U);
  EXPECT_EQ(picks[0].view, 2U);
  EXPECT_NEAR(picks[0].value, 2.0, 1e-12);
}

TEST(GreedyEntropyViews, DropsTheFacesSeen) {
  // The second view has more entropy than the third, but the first has seen all of it.
  const ViewChannel channel{6,
                            {{{0, 1.0F}, {1, 1.0F}, {2, 1.0F}, {3, 1.0F}},
                             {{0, 1.0F}, {1, 1.0F}, {2, 1.0F}},
                             {{4, 1.0F}, {5, 1.0F}}}};
  const auto picks = greedy_entropy_views(channel, 3);
  ASSERT_EQ(picks.size(), 2U);  // nothing is left for a third
  EXPECT_EQ(picks[0].view, 0U);
  EXPECT_EQ(picks[1].view, 2U);
  EXPECT_NEAR(picks[1].value, 1.0, 1e-12);
}

TEST(GreedyEntropyViews, AViewThatSeesNothingIsNeverChosen) {
  const ViewChannel channel{2, {{}, {{0, 1.0F}, {1, 1.0F}}}};
  const auto picks = greedy_entropy_views(channel, 5);
  ASSERT_EQ(picks.size(), 1U);
  EXPECT_EQ(picks[0].view, 1U);
}

TEST(MergeViews, StartsWithTheViewOfLeastMutualInformation) {
  const ViewChannel channel = half_seen_channel(12, 30, 4);
  std::size_t least = 0;
  for (std::size_t v = 1; v < 12; ++v) {
    if (merged_information(channel, {v}) < merged_information(channel, {least})) {
      least = v;
    }
  }
  const MergedViews merged = merge_views(channel, 1);
  ASSERT_EQ(merged.picks.size(), 1U);
  EXPECT_EQ(merged.picks[0].view, least);
}

TEST(MergeViews, EveryStepIsTheDefinitionsBest) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ViewChannel channel = half_seen_channel(10, 25, seed);
    const MergedViews merged = merge_views(channel, 6);
    std::vector<std::size_t> chosen;
    for (const ChannelPick& pick : merged.picks) {
      double least = INFINITY;
      for (std::size_t v = 0; v < 10; ++v) {
        if (std::find(chosen.begin(), chosen.end(), v) == chosen.end()) {
          chosen.push_back(v);
          least = std::min(least, merged_information(channel, chosen));
          chosen.pop_back();
        }
      }
      chosen.push_back(pick.view);
      EXPECT_NEAR(merged_information(channel, chosen), least, 1e-12);
      EXPECT_NEAR(pick.value, least, 1e-12);
    }
  }
}

TEST(MergeViews, AllViewsMergedTellNothing) {
  const MergedViews merged = merge_views(half_seen_channel(8, 20, 1), 8);
  ASSERT_EQ(merged.picks.size(), 8U);
  EXPECT_NEAR(merged.picks.back().value, 0.0, 1e-12);
}

TEST(MergeViews, GivesTheChannelsInformation) {
  // Two views, each with a face of its own: I(V;Z) is 1 bit, and each view's VMI too.
  const ViewChannel channel{2, {{{0, 1.0F}}, {{1, 1.0F}}}};
  const MergedViews merged = merge_views(channel, 2);
  EXPECT_NEAR(merged.channel_information, 1.0, 1e-12);
  EXPECT_EQ(merged.picks[0].view, 0U);
  EXPECT_NEAR(merged.picks[0].value, 1.0, 1e-12);
}

TEST(MergeViews, StopsAtTheShareOfInformation) {
  const ViewChannel channel = half_seen_channel(10, 25, 2);
  const MergedViews merged = merge_views(channel, 10, 0.5);
  const double limit = 0.5 * merged.channel_information;
  EXPECT_LE(merged.picks.back().value, limit);
  for (std::size_t i = 0; i + 1 < merged.picks.size(); ++i) {
    EXPECT_GT(merged.picks[i].value, limit);
  }
}

TEST(MergeViews, BlindViewsAreLeftOut) {
  const ViewChannel channel{1, {{}, {{0, 1.0F}}, {}}};
  const MergedViews merged = merge_views(channel, 3);
  ASSERT_EQ(merged.picks.size(), 1U);
  EXPECT_EQ(merged.picks[0].view, 1U);
  EXPECT_EQ(merged.channel_information, 0.0);
}

TEST(Channel, MalformedTablesAreRefused) {
  EXPECT_THROW(merge_views({1, {{{1, 1.0F}}}}, 1), InvalidInput);             // no such face
  EXPECT_THROW(merge_views({2, {{{1, 1.0F}, {0, 1.0F}}}}, 1), InvalidInput);  // not ascending
  EXPECT_THROW(greedy_entropy_views({1, {{{0, 0.0F}}}}, 1), InvalidInput);    // no area
  EXPECT_THROW(greedy_entropy_views({1, {{{0, NAN}}}}, 1), InvalidInput);     // not a number
  EXPECT_THROW(merge_views({1, {{{0, 1.0F}}}}, 1, 1.5), InvalidInput);        // no such share
}

TEST(ChannelTable, HoldsTheProjectedAreaOfACubesSide) {
  const TriMesh cube = test::box(1.0, 1.0, 1.0, 1);
  const std::vector<Viewpoint> eyes{{Projection::Orthographic, Vec3::UnitX()}};
  const FaceVisibility faces(cube, {FaceSides::Front});
  const ViewChannel channel = channel_table(faces, eyes);
  double area = 0.0;
  for (const FaceArea& a : channel.views[0]) {
    area += static_cast<double>(a.area);
  }
  EXPECT_NEAR(area * faces.area_unit(), 1.0, 1e-6);
}

/// A triangle of area 18 at x = 0 with a square of area 4 in front of each corner, seen from +x.
class TriangleBehindPlates : public testing::Test {
 protected:
  TriangleBehindPlates() {
    mesh.positions = {Vec3(0, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 6)};
    mesh.triangles = {{0, 1, 2}};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      const Vec3 centre = mesh.positions[corner] + Vec3(1, 0, 0);
      for (const auto& [y, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.push_back(centre + Vec3(0, y, z));
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }

  TriMesh mesh{};
  std::vector<FaceSides> sides{FaceSides::Both};
  std::vector<Viewpoint> eyes{{Projection::Orthographic, Vec3::UnitX()}};
};

TEST_F(TriangleBehindPlates, IsInTheChannelThoughNoCornerIsSeen) {
  const VertexVisibility visibility(mesh, sides);
  const auto visible = visibility.visible_vertices(eyes[0]);
  EXPECT_EQ(std::count(visible.begin(), visible.begin() + 3, 0), 3);
  const FaceVisibility faces(mesh, sides);
  const ViewChannel channel = channel_table(faces, eyes);
  ASSERT_EQ(channel.views[0].size(), 7U);
  EXPECT_EQ(channel.face_count, 7U);
  // The squares hide 1, 1/2 and 1/2 of the triangle.
  EXPECT_EQ(channel.views[0][0].face, 0U);
  EXPECT_NEAR(static_cast<double>(channel.views[0][0].area) * faces.area_unit(), 16.0, 0.16);
  for (std::size_t f = 1; f < 7; ++f) {
    EXPECT_NEAR(static_cast<double>(channel.views[0][f].area) * faces.area_unit(), 2.0, 1e-5);
  }
}

TEST_F(TriangleBehindPlates, IsTheSameChannelForAnyThreads) {
  const FaceVisibility faces(mesh, sides);
  eyes.resize(7, {Projection::Perspective, Vec3(20, 3, 1)});
  const ViewChannel one = channel_table(faces, eyes, {.max_threads = 1});
  const ViewChannel three =
      test::with_many_threads([&] { return channel_table(faces, eyes, {.max_threads = 3}); });
  for (std::size_t v = 0; v < eyes.size(); ++v) {
    ASSERT_EQ(one.views[v].size(), three.views[v].size());
    for (std::size_t k = 0; k < one.views[v].size(); ++k) {
      EXPECT_EQ(one.views[v][k].area, three.views[v][k].area);
    }
  }
}

}  // namespace
}  // namespace vantage
