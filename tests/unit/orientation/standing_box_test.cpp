// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/orientation/orientation.h"

#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A board on four legs, upright in z.
TriMesh table() {
  TriMesh mesh = together(TriMesh{}, box(2.0, 1.0, 0.1, 2), {0.0, 0.0, 0.8});
  for (const double x : {0.0, 1.9}) {
    for (const double y : {0.0, 0.9}) {
      mesh = together(mesh, box(0.1, 0.1, 0.8, 1), {x, y, 0.0});
    }
  }
  return mesh;
}

TEST(StandingRotation, LeavesWhatStandsAlongTheAxes) {
  EXPECT_EQ(standing_rotation(table()), Eigen::Matrix3d::Identity());
  EXPECT_EQ(standing_rotation(box(1.0, 2.0, 3.0, 2)), Eigen::Matrix3d::Identity());
  EXPECT_EQ(standing_rotation(TriMesh{}), Eigen::Matrix3d::Identity());
}

TEST(StandingRotation, UndoesATurnOffTheAxes) {
  const Vec3 axis = Vec3(1.0, 2.0, -0.5).normalized();
  for (const double angle : {0.2, 0.5}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    TriMesh mesh = table();
    for (Vec3& p : mesh.positions) {
      p = turn * p;
    }
    EXPECT_LT((standing_rotation(mesh) * turn - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace vantage::test
