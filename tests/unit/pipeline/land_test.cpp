// SPDX-License-Identifier: MIT
#include "pipeline/land.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// An OBJ of a sheet over 3 × 2 in x and y. \param height of a place.
template <class Height>
Model land(Height&& height, int cells = 24) {
  TriMesh mesh = sheet(3.0, 2.0, cells);
  for (Vec3& p : mesh.positions) {
    p.z() = height(p.x(), p.y());
  }
  Model model = model_of(mesh);
  model.format = ModelFormat::Obj;
  return model;
}

double hill(double x, double y) {
  return 0.2 * std::sin(3.0 * x) * std::cos(4.0 * y) + 0.1 * x;
}

TEST(UpOfLand, OfAHeightFieldIsItsHeight) {
  Model model = land(hill);
  ASSERT_TRUE(up_of_land(model));
  EXPECT_EQ(up_of_land(model)->axis, UpAxis::Z);
  EXPECT_EQ(up_of_land(model)->habit, UpHabit::HeightField);
  EXPECT_EQ(default_up(model), UpAxis::Z);
  for (Vec3& p : model.mesh.positions) {
    p = Vec3(p.x(), p.z(), p.y());  // a mirror image: wound from below
  }
  ASSERT_TRUE(up_of_land(model));
  EXPECT_EQ(up_of_land(model)->axis, UpAxis::Y);
  model.format = ModelFormat::Stl;
  EXPECT_EQ(default_up(model), UpAxis::Y);
}

TEST(UpOfLand, IsNotAskedWhereTheFileSaysWhatIsUp) {
  Model model = land(hill);
  model.format = ModelFormat::Glb;
  EXPECT_FALSE(up_of_land(model));
  model.format = ModelFormat::Obj;
  model.usual_up = Vec3::UnitY();
  EXPECT_FALSE(up_of_land(model));
}

TEST(UpOfLand, OtherSheetsMayStand) {
  EXPECT_FALSE(up_of_land(land([](double, double) { return 0.0; })));  // a screen
  EXPECT_FALSE(
      up_of_land(land([](double x, double) { return 0.2 * std::sin(9.0 * x); })));      // a curtain
  EXPECT_FALSE(up_of_land(land([](double x, double y) { return 2.2 * hill(x, y); })));  // a mask
  EXPECT_FALSE(up_of_land(land(hill, 5)));                                              // a sail
}

TEST(UpOfLand, IsOneSheetOverARectangle) {
  const Model model = land(hill);
  Model doubled = model;
  doubled.mesh = together(model.mesh, model.mesh, Vec3(0.0, 0.0, 0.1));
  EXPECT_FALSE(up_of_land(doubled));
  Model round = model;
  std::erase_if(round.mesh.triangles, [&](const Triangle& t) {
    const Vec3 p = round.mesh.positions[t[0]] - Vec3(1.5, 1.0, 0.0);
    return std::hypot(p.x() / 1.5, p.y()) > 1.0;
  });
  EXPECT_FALSE(up_of_land(round));
  Model wild = model;  // wound either way: of a shape that folds, or that has a back
  for (std::size_t i = 0; i < wild.mesh.triangles.size(); i += 9) {
    std::swap(wild.mesh.triangles[i][1], wild.mesh.triangles[i][2]);
  }
  EXPECT_FALSE(up_of_land(wild));
}

}  // namespace
}  // namespace vantage::test
