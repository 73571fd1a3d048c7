// SPDX-License-Identifier: MIT
#include "choice/view_habit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"

#include "support/shapes.h"

namespace vantage::test {
namespace {

constexpr double kRight = std::numbers::pi / 2.0;

/// A table of one view of a flat thing and one of a tall one.
ChoiceTable of_two() {
  ChoiceTable table;
  table.bandwidth = 0.1;
  table.choices = {{.shape = {.height = -3.0}, .direction = Vec3(0.0, 1.0, 0.0)},
                   {.shape = {.height = 2.0}, .direction = Vec3(0.6, 0.0, 0.8)}};
  return table;
}

TEST(ViewHabit, IsThatOfTheShapesThatAreAlike) {
  const ChoiceTable table = of_two();
  const ViewHabit flat(table, {.height = -3.0});
  const ViewHabit tall(table, {.height = 2.0});
  // The other view weighs 1e-4.
  EXPECT_NEAR(flat.distance(Vec3::UnitY()), 0.0, 2e-4);
  EXPECT_NEAR(flat.distance(Vec3::UnitZ()), kRight, 2e-4);
  EXPECT_NEAR(tall.distance(Vec3(0.6, 0.0, 0.8)), 0.0, 2e-4);
  EXPECT_NEAR(tall.distance(Vec3::UnitY()), kRight, 2e-4);
}

TEST(ViewHabit, TakesLeftForRightAndFrontForBackOnlyOfWhatMirrorsThem) {
  ChoiceTable table = of_two();
  const Vec3 front(-0.6, 0.0, 0.8);
  const Vec3 back(0.6, 0.0, -0.8);
  const ShapeProportions tall{.height = 2.0};
  EXPECT_NEAR(ViewHabit(table, tall).distance(front), 0.0, 2e-4);
  EXPECT_NEAR(ViewHabit(table, tall).distance(back), std::acos(0.36 - 0.64), 2e-4);
  table.choices.back().shape.mirrors_front = true;
  EXPECT_NEAR(ViewHabit(table, {.height = 2.0, .mirrors_front = true}).distance(back), 0.0, 2e-4);
}

TEST(ViewHabit, OfAShapeLikeNoOtherIsTheMeanOfAll) {
  const ChoiceTable table = of_two();
  const ViewHabit odd(table, {.height = 1e15});
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    const double to_first = std::acos(d.y());
    const double to_second = std::acos(std::abs(0.6 * d.x()) + 0.8 * d.z());
    EXPECT_NEAR(odd.distance(d), (to_first + to_second) / 2.0, 1e-12);
  }
}

TEST(ViewHabit, OneOddChoiceIsNoHabit) {
  ChoiceTable table;
  table.bandwidth = 0.1;
  table.choices = {{.shape = {.height = 0.0}, .direction = Vec3::UnitY()}};
  for (int i = 0; i < 6; ++i) {
    table.choices.push_back({.shape = {.height = 1.0}, .direction = Vec3::UnitZ()});
  }
  // Alone it would be all there is; widened, the kernel gives it half of the weight at most.
  const ViewHabit habit(table, {.height = 0.0});
  EXPECT_GE(habit.distance(Vec3::UnitY()), 0.5 * kRight);
  EXPECT_GE(habit.distance(Vec3::UnitZ()), 0.3 * kRight);
}

TEST(Proportions, AreThoseOfTheBoxInItsFrame) {
  const TriMesh mesh = box(2.0, 1.0, 4.0, 2);
  const UprightFrame lying{.side = Vec3::UnitY(), .up = Vec3::UnitZ(), .front = Vec3::UnitX()};
  const std::vector<MirrorPlane> planes{{.normal = Vec3::UnitZ()}};
  const ShapeProportions found = proportions_of(mesh, 1.0, planes, lying);
  EXPECT_NEAR(found.height, std::log(4.02 / std::sqrt(1.02 * 2.02)), 1e-12);
  EXPECT_NEAR(found.width, std::log(1.02 / 2.02), 1e-12);
  EXPECT_FALSE(found.mirrors_side);
  EXPECT_FALSE(found.mirrors_front);
  EXPECT_TRUE(found.mirrors_up);
}

}  // namespace
}  // namespace vantage::test
