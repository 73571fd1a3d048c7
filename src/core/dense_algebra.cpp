// SPDX-License-Identifier: MIT
#include "core/dense_algebra.h"

#include <Eigen/QR>

namespace vantage {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::Quaterniond shortest_rotation(const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace vantage
