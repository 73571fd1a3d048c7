// SPDX-License-Identifier: MIT
#include "vantage/view/landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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

std::vector<Vec3> landmarks_of(const TriMesh& surface) {
  return landmark_directions(surface, flat_parts(surface));
}

TEST(Landmarks, OfATurnedCubeAreItsSixNormalsAndTheSixAxes) {
  const std::vector<Vec3> found = landmarks_of(turned_cube(1.0));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      EXPECT_TRUE(holds(found, sign * (kTurn * Vec3::Unit(axis))));
      EXPECT_TRUE(holds(found, sign * Vec3::Unit(axis)));
    }
  }
}

TEST(Landmarks, OfATurnedRingHoldItsAxisAndNoChanceDirection) {
  const TriMesh ring = test::moved(test::torus(1.0, 0.3, 48, 24), 1.0, 0.7, kAxis, Vec3::Zero());
  const std::vector<Vec3> found = landmarks_of(ring);
  EXPECT_EQ(found.size(), 8U);  // three axes of the coordinates and its own, both ways
  EXPECT_TRUE(holds(found, kTurn * Vec3::UnitZ()));
}

TEST(Landmarks, OfARoundSurfaceAreAxesAlone) {
  const std::vector<Vec3> found = landmarks_of(test::sphere(4));
  EXPECT_LE(found.size(), 12U);  // six of the coordinates, six of whatever the principal axes are
}

TEST(Landmarks, AreUnitVectorsInOppositePairs) {
  const std::vector<Vec3> found = landmarks_of(turned_cube(1.0));
  ASSERT_EQ(found.size() % 2, 0U);
  for (std::size_t i = 0; i < found.size(); i += 2) {
    EXPECT_NEAR(found[i].norm(), 1.0, 1e-12);
    EXPECT_EQ(found[i + 1], Vec3(-found[i]));
  }
}

TEST(Landmarks, DoNotDependOnScale) {
  const std::vector<Vec3> expected = landmarks_of(turned_cube(1.0));
  const std::vector<Vec3> found = landmarks_of(turned_cube(1e8));
  ASSERT_EQ(found.size(), expected.size());
  for (const Vec3& d : expected) {
    EXPECT_TRUE(holds(found, d));
  }
}

TEST(Landmarks, OfNothingAreNone) {
  EXPECT_TRUE(landmarks_of({}).empty());
  const TriMesh flat{.positions = {Vec3::Zero(), Vec3::UnitX(), 2.0 * Vec3::UnitX()},
                     .triangles = {{0, 1, 2}}};
  EXPECT_TRUE(landmarks_of(flat).empty());
}

/// A cube around the origin, of which all corners lie on the camera's sphere.
std::vector<Vec3> brinks_of_cube(double side, const ScoringCamera& camera) {
  TriMesh cube = test::box(side, side, side, 1);
  for (Vec3& p : cube.positions) {
    p -= Vec3::Constant(0.5 * side);
  }
  return brink_directions(flat_parts(cube), camera);
}

TEST(Brinks, OfACubeLieJustBeforeAndBehindThePlanesOfItsWalls) {
  for (const double side : {1e-4, 1.0, 1e4}) {
    const ScoringCamera camera{.sphere = {Vec3::Zero(), std::sqrt(3.0) * side}};
    const std::vector<Vec3> found = brinks_of_cube(side, camera);
    // Six walls, four fronts across each of them, before and behind.
    EXPECT_EQ(found.size(), 48U);
    for (const Vec3& direction : found) {
      // One coordinate of the eye is half a side and a hundredth of its distance more or less; of
      // the others one is 0, and one is almost all of the distance.
      const Vec3 eye = camera.distance() * direction;
      std::array<double, 3> sorted{std::abs(eye.x()), std::abs(eye.y()), std::abs(eye.z())};
      std::sort(sorted.begin(), sorted.end());
      EXPECT_NEAR(sorted[0], 0.0, 1e-12 * side);
      EXPECT_NEAR(std::abs(sorted[1] - 0.5 * side), 0.01 * camera.distance(), 1e-12 * side);
    }
  }
}

TEST(Brinks, InParallelProjectionLieAlmostAcrossTheWalls) {
  const std::vector<Vec3> found = brinks_of_cube(
      1.0, {.sphere = {Vec3::Zero(), std::sqrt(3.0)}, .projection = Projection::Orthographic});
  EXPECT_EQ(found.size(), 48U);
  for (const Vec3& direction : found) {
    EXPECT_NEAR(direction.cwiseAbs().maxCoeff(), std::sqrt(1.0 - 0.01 * 0.01), 1e-12);
  }
}

TEST(Brinks, OfARoundSurfaceAreNone) {
  EXPECT_TRUE(
      brink_directions(flat_parts(test::sphere(4)), {.sphere = {Vec3::Zero(), 2.0}}).empty());
}

TEST(FlatParts, OfFacesWhoseAreaIsHardlyANumberAreFinite) {
  for (const double size : {1e-80, 1e-81, 1e-85, 1e-100}) {
    const TriMesh tiny{{Vec3::Zero(), size * Vec3::UnitX(), size * Vec3(0.2, 1.0, 0.7)},
                       {{0, 1, 2}}};
    for (const FlatPart& part : flat_parts(tiny)) {
      EXPECT_TRUE(part.normal.allFinite()) << size;
    }
  }
}

}  // namespace
}  // namespace vantage
