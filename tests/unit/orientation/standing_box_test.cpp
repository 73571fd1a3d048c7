// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/orientation/orientation.h"

#include "support/shapes.h"
#include "unit/orientation/table.h"

namespace vantage::test {
namespace {

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
