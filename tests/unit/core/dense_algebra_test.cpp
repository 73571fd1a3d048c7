// SPDX-License-Identifier: MIT
#include "core/dense_algebra.h"

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(LeastSquares, LeaveARestThatNoColumnLessens) {
  Eigen::MatrixXd A(4, 2);
  A << 1, 0, 1, 1, 1, 2, 1, 3;
  const Eigen::Vector4d b(1.0, 0.0, 2.0, 5.0);
  const Eigen::VectorXd x = least_squares(A, b);
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), 1e-12);
}

TEST(LeastSquares, TakeTheShortestOfEqualSolutions) {
  Eigen::MatrixXd A(2, 2);
  A << 1, 1, 1, 1;
  EXPECT_TRUE(least_squares(A, Eigen::Vector2d(2.0, 2.0)).isApprox(Eigen::Vector2d(1.0, 1.0)));
}

TEST(ShortestRotation, TakesOneDirectionToTheOtherAndKeepsTheirNormal) {
  const Vec3 from(1.0, 2.0, -0.5);
  const Vec3 to(-0.3, 0.4, 2.0);
  const Eigen::Quaterniond turn = shortest_rotation(from, 7.0 * to);
  EXPECT_TRUE((turn * from.normalized()).isApprox(to.normalized()));
  EXPECT_TRUE((turn * from.cross(to)).isApprox(from.cross(to)));
}

TEST(ShortestRotation, OfOppositeDirectionsIsHalfATurn) {
  const Vec3 from(1.0, 2.0, -0.5);
  EXPECT_TRUE((shortest_rotation(from, -from) * from).isApprox(-from));
}

}  // namespace
}  // namespace vantage
