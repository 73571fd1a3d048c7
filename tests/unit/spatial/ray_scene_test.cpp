// SPDX-License-Identifier: MIT
#include "spatial/ray_scene.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

TEST(RayScene, HitsTheNearerSideOfABox) {
  const RayScene scene(test::box(1.0, 1.0, 1.0, 1));
  const RayHit hit = scene.closest_hit({0.3F, 0.4F, 3.0F}, {0.0F, 0.0F, -2.0F});
  ASSERT_TRUE(hit);
  // From z = 3 to the side z = 1 in steps of 2.
  EXPECT_FLOAT_EQ(hit.t, 1.0F);
}

TEST(RayScene, NamesTheCornersWeightsOfAHit) {
  const TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const RayHit hit = RayScene(mesh).closest_hit({0.25F, 0.5F, 1.0F}, {0.0F, 0.0F, -1.0F});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit.face, 0U);
  EXPECT_FLOAT_EQ(hit.u, 0.25F);
  EXPECT_FLOAT_EQ(hit.v, 0.5F);
}

TEST(RayScene, MissesBesideAndBeyondTheFarEnd) {
  const RayScene scene(test::box(1.0, 1.0, 1.0, 1));
  EXPECT_FALSE(scene.closest_hit({1.5F, 0.5F, 3.0F}, {0.0F, 0.0F, -1.0F}));
  EXPECT_FALSE(scene.closest_hit({0.5F, 0.5F, 3.0F}, {0.0F, 0.0F, -1.0F}, 0.0F, 1.9F));
  EXPECT_TRUE(scene.closest_hit({0.5F, 0.5F, 3.0F}, {0.0F, 0.0F, -1.0F}, 0.0F, 2.1F));
}

TEST(RayScene, TracesRaysTogetherAsItDoesOneByOne) {
  const RayScene scene(test::box(1.0, 1.0, 1.0, 3));
  RayPacket packet;
  for (std::size_t i = 0; i < packet.size(); ++i) {
    const auto x = static_cast<float>(i);
    packet[i] = {Vec3f(0.3F * x + 0.17F, 0.41F, 3.0F), Vec3f(0.0F, 0.05F * x, -1.0F)};
  }
  const auto hits = scene.closest_hits(packet, packet.size());
  std::size_t blocked = 0;
  for (std::size_t i = 0; i < packet.size(); ++i) {
    const RayHit alone = scene.closest_hit(packet[i].origin, packet[i].direction);
    EXPECT_EQ(hits[i].face, alone.face) << i;
    EXPECT_NEAR(hits[i].t, alone.t, 1e-6F) << i;
    blocked += alone ? 1 : 0;
  }
  EXPECT_EQ(scene.count_occluded(packet, packet.size()), blocked);
  EXPECT_EQ(blocked, 3U);  // the last starts beside the box
}

TEST(RayScene, TracesOfManyFacesInOnePlaceAsManyAsPicturesLookThrough) {
  constexpr std::uint32_t kCopies = 1000;
  TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, {}};
  mesh.triangles.assign(kCopies, {0, 1, 2});
  mesh.triangles.push_back({3, 4, 5});
  std::size_t asked = 0;
  const RayScene scene(mesh, [&asked](std::uint32_t face, float, float, float) {
    ++asked;
    return face == kCopies ? 1.0 : 0.0;  // all holes but the one behind
  });
  const RayHit hit = scene.closest_hit({0.25F, 0.25F, 1.0F}, {0.0F, 0.0F, -1.0F});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit.face, kCopies);
  EXPECT_EQ(scene.closest_hits({RaySegment{{0.2F, 0.2F, 1.0F}, {0, 0, -1.0F}}}, 1)[0].face,
            kCopies);
  EXPECT_LE(asked, 100U);
}

TEST(RayScene, LeavesTheRestOfAPacketAlone) {
  const RayScene scene(test::box(1.0, 1.0, 1.0, 1));
  RayPacket packet;
  packet.fill({Vec3f(0.3F, 0.4F, 3.0F), Vec3f(0.0F, 0.0F, -1.0F)});
  const auto hits = scene.closest_hits(packet, 2);
  EXPECT_TRUE(hits[1]);
  EXPECT_FALSE(hits[2]);
  EXPECT_EQ(scene.count_occluded(packet, 3), 3U);
}

TEST(RayScene, OfNothingIsNeverHit) {
  const RayScene scene(TriMesh{});
  EXPECT_FALSE(scene.closest_hit({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}));
}

TEST(CandidateScene, NamesEveryFaceOnTheWay) {
  const TriMesh mesh = test::box(1.0, 1.0, 1.0, 1);
  const CandidateScene scene(mesh.positions, mesh.triangles);
  int named = 0;
  const bool stopped = scene.any({0.3, 0.4, -1.0}, Vec3::UnitZ(),
                                 std::numeric_limits<double>::infinity(), [&](std::uint32_t) {
                                   ++named;
                                   return false;
                                 });
  EXPECT_FALSE(stopped);
  EXPECT_GE(named, 4);  // two triangles at z = 0, two at z = 1; their boxes all hold the ray
}

TEST(UnitFrame, BringsTheLongestSideToOneToTwoWithAPowerOfTwo) {
  const std::vector<Vec3> points{{10, 20, 30}, {13, 21, 30}};
  const UnitFrame frame = unit_frame(points);
  EXPECT_EQ(frame.scale, 0.5);  // 3 becomes 1.5
  EXPECT_EQ(frame.centre, Vec3(11.5, 20.5, 30));
}

TEST(UnitFrame, OfOnePointLeavesItsScale) {
  const std::vector<Vec3> points{{1, 2, 3}};
  EXPECT_EQ(unit_frame(points).scale, 1.0);
}

}  // namespace
}  // namespace vantage
