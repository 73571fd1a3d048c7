// SPDX-License-Identifier: MIT
#include "mesh/place_order.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

/// Points that are alike on both sides of the plane x = 0, and nowhere else.
std::vector<Vec3> mirrored() {
  return {{1, 0, 0}, {-1, 0, 0}, {2, 1, 3}, {-2, 1, 3}, {0, 4, 1}, {0.5, -2, 0}, {-0.5, -2, 0}};
}

std::vector<Vec3> turned(const std::vector<Vec3>& points, const Vec3& shift) {
  return test::moved({.positions = points, .triangles = {}}, 1e6, 0.8, Vec3(1, 2, 3), shift)
      .positions;
}

TEST(OwnDirection, TurnsWithThePoints) {
  const Vec3 plain = own_direction(mirrored());
  const Vec3 other = own_direction(turned(mirrored(), {3e6, 0, 1e6}));
  const Vec3 expected = turned({plain}, Vec3::Zero()).front() / 1e6;
  EXPECT_NEAR(plain.norm(), 1.0, 1e-12);
  EXPECT_LE((other - expected).norm(), 1e-9);
}

TEST(OwnDirection, DoesNotDependOnTheOrderOfPoints) {
  std::vector<Vec3> reversed = mirrored();
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_LE((own_direction(reversed) - own_direction(mirrored())).norm(), 1e-12);
}

TEST(OwnDirection, IsNoneWhereEveryPointHasItsOpposite) {
  EXPECT_EQ(own_direction(std::vector<Vec3>{{1, 2, 3}, {-1, -2, -3}, {0, 5, 0}, {0, -5, 0}}),
            Vec3::Zero());
  EXPECT_EQ(own_direction(std::vector<Vec3>{{1, 2, 3}}), Vec3::Zero());
  EXPECT_EQ(own_direction({}), Vec3::Zero());
}

TEST(PlaceOrder, TellsMirrorImagesApart) {
  const std::vector<Vec3> points = mirrored();
  const PlaceOrder order(points);
  EXPECT_NE(order.place(points[2], points[4]), order.place(points[3], points[4]));
  EXPECT_EQ(order.steps((points[2] - points[4]).norm()),
            order.steps((points[3] - points[4]).norm()));
}

TEST(PlaceOrder, PutsEdgesInTheSameOrderHoweverPointsAreTurnedAndScaled) {
  const std::vector<Vec3> points = mirrored();
  const std::vector<Vec3> others = turned(points, {3e6, 0, 1e6});
  const PlaceOrder order(points);
  const PlaceOrder turned_order(others);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      EXPECT_EQ(order.place(points[i], points[i]) < order.place(points[j], points[j]),
                turned_order.place(others[i], others[i]) < turned_order.place(others[j], others[j]))
          << i << ", " << j;
      EXPECT_NEAR(order.steps((points[i] - points[j]).norm()),
                  turned_order.steps((others[i] - others[j]).norm()), 1.0);
    }
  }
}

}  // namespace
}  // namespace vantage
