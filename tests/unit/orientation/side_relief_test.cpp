// SPDX-License-Identifier: MIT
#include "orientation/side_relief.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/orientation/table.h"

namespace vantage::test {
namespace {

TEST(SideRelief, OfABoxTouchesEverywhereAndShowsNoDepth) {
  const HeightFields fields(box(1.0, 2.0, 4.0, 3));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SideRelief look = side_relief(fields, axis, true);
    EXPECT_EQ(look.touch, 1.0);
    EXPECT_NEAR(look.touch_hull, 1.0, 1e-12);
    EXPECT_EQ(look.contacts, 1.0);  // log2(1 + 1)
    EXPECT_EQ(look.depth, 0.0);
    EXPECT_EQ(look.back, 0.0);
  }
  // The nearest border of the middle of a 1 x 2 base is half a unit away.
  EXPECT_NEAR(side_relief(fields, 2, false).margin, 0.5 / std::sqrt(2.0), 1e-9);
}

TEST(SideRelief, OfASheetThatIsThinnerThanFloatsTellIsThatOfAFlatOne) {
  TriMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-46}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const HeightFields fields(sheet);
  for (const bool from_high : {true, false}) {
    EXPECT_EQ(side_relief(fields, 2, from_high).touch, 1.0);
    EXPECT_EQ(side_relief(fields, 2, from_high).depth, 0.0);
  }
}

TEST(SideRelief, OfATableFromBelowHasFourFeetAroundItsWholeOutline) {
  const HeightFields fields(table());
  const SideRelief base = side_relief(fields, 2, false);
  const SideRelief top = side_relief(fields, 2, true);
  EXPECT_NEAR(base.contacts, std::log2(5.0), 1e-12);
  EXPECT_NEAR(base.touch_hull, 1.0, 1e-9);
  EXPECT_LT(base.touch, 0.1);
  EXPECT_EQ(top.touch, 1.0);
  EXPECT_GT(base.depth, 0.3);  // nearly 0.8 of the longest side, 2
}

TEST(SideRelief, OfAClosedShapeShowsNoBacksAndInsideOutNothingElse) {
  const TriMesh mesh = cylinder(0.5, 1.0, 64, 8);
  const HeightFields outwards(mesh);
  const HeightFields inwards(inside_out(mesh));
  for (const bool from_high : {true, false}) {
    EXPECT_EQ(side_relief(outwards, 2, from_high).back, 0.0);
    EXPECT_GT(side_relief(inwards, 2, from_high).back, 0.9);  // but for cells of the rim alone
  }
}

TEST(MirrorError, IsNoneForABoxAndSomeForAConeUpsideDown) {
  const HeightFields fields(box(1.0, 2.0, 3.0, 2));
  TriMesh cone = cylinder(1.0, 2.0, 64, 8);
  for (Vec3& p : cone.positions) {
    p.x() *= 1.0 - 0.45 * p.z();
    p.y() *= 1.0 - 0.45 * p.z();
  }
  const HeightFields of_cone(cone);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mirror_error(fields, axis), 0.0, 1e-6);  // heights are float
    EXPECT_NEAR(half_turn_error(fields, axis), 0.0, 1e-6);
  }
  EXPECT_EQ(quarter_turn_error(fields, 2), 1.0);  // sides of 1 and 2
  EXPECT_LT(mirror_error(of_cone, 0), 0.02);
  EXPECT_LT(quarter_turn_error(of_cone, 2), 0.02);
  EXPECT_GT(mirror_error(of_cone, 2), 0.3);
}

TEST(HeightFields, AreThoseOfTheShapeWhateverItsSizePlaceAndOrder) {
  const TriMesh mesh = table();
  const HeightFields plain(mesh);
  const HeightFields other(
      moved(renumbered(mesh, 5), 1024.0, 0.0, Vec3::UnitX(), Vec3(4096.0, 0.0, -2048.0)));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SideRelief a = side_relief(plain, axis, true);
    const SideRelief b = side_relief(other, axis, true);
    EXPECT_NEAR(a.touch, b.touch, 1e-9);
    EXPECT_NEAR(a.depth, b.depth, 1e-6);
    EXPECT_NEAR(a.detail, b.detail, 1e-6);
  }
}

}  // namespace
}  // namespace vantage::test
