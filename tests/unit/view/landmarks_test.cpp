// SPDX-License-Identifier: MIT
#include "vantage/view/landmarks.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

bool holds(const std::vector<Vec3>& directions, const Vec3& wanted) {
  return std::any_of(directions.begin(), directions.end(),
                     [&](const Vec3& d) { return angle_between(d, wanted) < 1e-6; });
}

const Vec3 kAxis = Vec3(0.2, 0.9, -0.4).normalized();
const Eigen::Matrix3d kTurn = Eigen::AngleAxisd(0.7, kAxis).toRotationMatrix();

TriMesh turned_cube(double scale) {
  return test::moved(test::box(1.0, 1.0, 1.0, 4), scale, 0.7, kAxis, Vec3::Zero());
}

TEST(Landmarks, OfATurnedCubeAreItsSixNormalsAndTheSixAxes) {
  const std::vector<Vec3> found = landmark_directions(turned_cube(1.0));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      EXPECT_TRUE(holds(found, sign * (kTurn * Vec3::Unit(axis))));
      EXPECT_TRUE(holds(found, sign * Vec3::Unit(axis)));
    }
  }
}

TEST(Landmarks, OfATurnedRingHoldItsAxisAndNoChanceDirection) {
  const TriMesh ring = test::moved(test::torus(1.0, 0.3, 48, 24), 1.0, 0.7, kAxis, Vec3::Zero());
  const std::vector<Vec3> found = landmark_directions(ring);
  EXPECT_EQ(found.size(), 8U);  // three axes of the coordinates and its own, both ways
  EXPECT_TRUE(holds(found, kTurn * Vec3::UnitZ()));
}

TEST(Landmarks, OfARoundSurfaceAreAxesAlone) {
  const std::vector<Vec3> found = landmark_directions(test::sphere(4));
  EXPECT_LE(found.size(), 12U);  // six of the coordinates, six of whatever the principal axes are
}

TEST(Landmarks, AreUnitVectorsInOppositePairs) {
  const std::vector<Vec3> found = landmark_directions(turned_cube(1.0));
  ASSERT_EQ(found.size() % 2, 0U);
  for (std::size_t i = 0; i < found.size(); i += 2) {
    EXPECT_NEAR(found[i].norm(), 1.0, 1e-12);
    EXPECT_EQ(found[i + 1], Vec3(-found[i]));
  }
}

TEST(Landmarks, DoNotDependOnScale) {
  const std::vector<Vec3> expected = landmark_directions(turned_cube(1.0));
  const std::vector<Vec3> found = landmark_directions(turned_cube(1e8));
  ASSERT_EQ(found.size(), expected.size());
  for (const Vec3& d : expected) {
    EXPECT_TRUE(holds(found, d));
  }
}

TEST(Landmarks, OfNothingAreNone) {
  EXPECT_TRUE(landmark_directions({}).empty());
  const TriMesh flat{.positions = {Vec3::Zero(), Vec3::UnitX(), 2.0 * Vec3::UnitX()},
                     .triangles = {{0, 1, 2}}};
  EXPECT_TRUE(landmark_directions(flat).empty());
}

}  // namespace
}  // namespace vantage
