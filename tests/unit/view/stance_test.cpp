// SPDX-License-Identifier: MIT
#include "view/stance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage::test {
namespace {

TriMesh shifted_box(double x, double y, double z, const Vec3& shift) {
  return moved(box(x, y, z, 2), 1.0, 0.0, Vec3::UnitX(), shift);
}

/// A plate of 4 × 3 on legs of 0.1 × 0.1 × 2 at its corners, z up.
TriMesh table() {
  TriMesh mesh = shifted_box(4.0, 3.0, 0.2, Vec3(0.0, 0.0, 2.0));
  for (const Vec3& foot : {Vec3(0, 0, 0), Vec3(3.9, 0, 0), Vec3(0, 2.9, 0), Vec3(3.9, 2.9, 0)}) {
    mesh = together(mesh, box(0.1, 0.1, 2.0, 2), foot);
  }
  return mesh;
}

TEST(Stance, OfATableIsOnTheHullOfItsFeet) {
  const Stance on_feet = stance(table(), Vec3::UnitZ(), {});
  EXPECT_NEAR(on_feet.base_share, 1.0, 1e-9);
  EXPECT_TRUE(on_feet.stands);
}

TEST(Stance, OfAConeOnItsTipDoesNotStand) {
  TriMesh cone = cylinder(1.0, 2.0, 32, 4);
  for (Vec3& p : cone.positions) {
    p.x() *= 1.0 - p.z() / 2.0;
    p.y() *= 1.0 - p.z() / 2.0;
  }
  const Stance on_base = stance(cone, Vec3::UnitZ(), {});
  const Stance on_tip = stance(cone, -Vec3::UnitZ(), {});
  EXPECT_TRUE(on_base.stands);
  EXPECT_NEAR(on_base.base_share, 1.0, 1e-9);
  // What is within 1 % of the tip has a hundredth of the radius at most.
  EXPECT_LE(on_tip.base_share, 0.01 * 0.01);
  // A cone's surface, cap included, has its centre at (π·l·r·h/3 + 0) / (π·l·r + π·r²), l² = 5.
  const double slant = std::sqrt(5.0);
  EXPECT_NEAR(on_base.centre_height, slant * (2.0 / 3.0) / (slant + 1.0) / 2.0, 0.01);
  EXPECT_NEAR(on_tip.centre_height, 1.0 - on_base.centre_height, 1e-9);
}

TEST(Stance, ALeaningTowerDoesNotStandThoughItsBaseIsBroad) {
  TriMesh tower = box(1.0, 1.0, 6.0, 4);
  for (Vec3& p : tower.positions) {
    p.x() += 0.5 * p.z();  // the centre is at x = 0.5 + 1.5, beyond the base that ends at 1.03
  }
  EXPECT_FALSE(stance(tower, Vec3::UnitZ(), {}).stands);
}

TEST(Stance, DoesNotChangeWithScaleOrPlace) {
  const Stance plain = stance(table(), Vec3::UnitZ(), {});
  for (const double scale : {1e-8, 1e8}) {
    const Stance scaled = stance(
        moved(table(), scale, 0.0, Vec3::UnitX(), scale * Vec3(1.0, 2.0, 3.0)), Vec3::UnitZ(), {});
    EXPECT_NEAR(scaled.base_share, plain.base_share, 1e-9);
    EXPECT_EQ(scaled.stands, plain.stands);
  }
}

TEST(Stance, KnowsHowMirrorPlanesLie) {
  const MirrorPlane planes[] = {{Vec3::UnitX(), Vec3::Zero()}};
  const Stance upright = stance(table(), Vec3::UnitZ(), planes);
  EXPECT_TRUE(upright.mirror_plane_upright);
  EXPECT_FALSE(upright.mirror_plane_level);
  const Stance level = stance(table(), Vec3::UnitX(), planes);
  EXPECT_TRUE(level.mirror_plane_level);
  EXPECT_FALSE(level.mirror_plane_upright);
}

TEST(StandsOnlyOn, NeedsABroadBaseOneWayAndNoneTheOther) {
  const Stance broad{.base_share = 0.5, .stands = true};
  const Stance none{.base_share = 0.01};
  EXPECT_TRUE(stands_only_on(broad, none));
  EXPECT_FALSE(stands_only_on(none, broad));
  EXPECT_FALSE(stands_only_on(broad, broad));
  EXPECT_FALSE(stands_only_on({.base_share = 0.5, .stands = false}, none));
  EXPECT_FALSE(stands_only_on({.base_share = 0.2, .stands = true}, none));
  EXPECT_FALSE(
      stands_only_on({.base_share = 0.5, .stands = true, .mirror_plane_level = true}, none));
}

}  // namespace
}  // namespace vantage::test
