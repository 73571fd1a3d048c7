// SPDX-License-Identifier: MIT
#include "orientation/surface_traits.h"

#include <cmath>

#include <gtest/gtest.h>

#include "orientation/side_relief.h"
#include "orientation/water.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

constexpr std::size_t kUp = 4;    // +z of six sides
constexpr std::size_t kDown = 5;  // −z

/// Walls of 0.1 on a floor, open above: a tub of 1 x 1 x 0.5.
TriMesh tub() {
  TriMesh mesh = box(1.0, 1.0, 0.1, 2);
  for (const double at : {0.0, 0.9}) {
    mesh = together(mesh, box(0.1, 1.0, 0.5, 2), {at, 0.0, 0.0});
    mesh = together(mesh, box(1.0, 0.1, 0.5, 2), {0.0, at, 0.0});
  }
  return mesh;
}

TEST(RainHeld, OfATubIsItsHollowUprightAndNothingUpsideDown) {
  const HeightFields fields(tub());
  // 0.4 deep in 0.8 x 0.8 of the outline, over a height of 0.5; cells are 1/64.
  EXPECT_NEAR(rain_held(fields.along[2], true), 0.64 * 0.8, 0.04);
  EXPECT_EQ(rain_held(fields.along[2], false), 0.0);
}

TEST(RainHeld, OfABoxIsNothing) {
  const HeightFields fields(box(1.0, 2.0, 3.0, 2));
  for (const HeightField& field : fields.along) {
    EXPECT_EQ(rain_held(field, true), 0.0);
    EXPECT_EQ(rain_held(field, false), 0.0);
  }
}

TEST(SideRelief, OfACubeRestsOnEachSideForOneSixthOfDirections) {
  const HeightFields fields(box(1.0, 1.0, 1.0, 4));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(side_relief(fields, axis, true).rest, 1.0 / 6.0, 1e-6);
    EXPECT_NEAR(side_relief(fields, axis, false).rest, 1.0 / 6.0, 1e-6);
    EXPECT_EQ(side_relief(fields, axis, false).patch, 1.0);
  }
}

TEST(SurfaceTraits, OfABoxFaceItsSidesAndBendAlongItsAxes) {
  const SurfaceTraits traits(box(1.0, 2.0, 4.0, 1));
  EXPECT_NEAR(traits.side[kUp].facing, 2.0 / 28.0, 1e-12);
  EXPECT_NEAR(traits.side[kUp].facing_place, 1.0, 1e-12);
  EXPECT_NEAR(traits.side[kDown].facing_place, 1.0, 1e-12);
  EXPECT_NEAR(traits.axis[0].edges_along, 1.0 / 7.0, 1e-12);
  EXPECT_NEAR(traits.axis[2].edges_along, 4.0 / 7.0, 1e-12);
  EXPECT_EQ(traits.open, 0.0);
  EXPECT_EQ(traits.parts, 0.0);  // log2(1)
}

TEST(SurfaceTraits, FindsWhatIsOpenAndWhichPartsStand) {
  TriMesh mesh = together(box(1.0, 1.0, 1.0, 1), box(0.2, 0.2, 0.2, 1), {0.4, 0.4, 2.0});
  const SurfaceTraits closed(mesh);
  EXPECT_NEAR(closed.side[kDown].parts_end, 0.5, 1e-12);
  EXPECT_NEAR(closed.side[kUp].parts_end, 0.5, 1e-12);
  EXPECT_EQ(closed.parts, 1.0);  // log2(2)
  // Without the large one's floor, its lower edges are open: 4 over a longest side of 2.2.
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.positions[t[0]].z() == 0.0 && mesh.positions[t[1]].z() == 0.0 &&
           mesh.positions[t[2]].z() == 0.0;
  });
  const SurfaceTraits open(mesh);
  EXPECT_NEAR(open.open, std::log2(1.0 + 4.0 / 2.2), 1e-12);
  EXPECT_NEAR(open.side[kDown].open_end, 4.0 / 2.2, 1e-12);
  EXPECT_EQ(open.side[kUp].open_end, 0.0);
}

}  // namespace
}  // namespace vantage::test
