// SPDX-License-Identifier: MIT
#include "core/dense_algebra.h"

#include <cmath>

#include <Eigen/QR>

namespace vantage {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::Quaterniond shortest_rotation(const Vec3& from, const Vec3& to) {
  // Not Eigen's FromTwoVectors(): for opposite directions it instantiates a decomposition.
  const Vec3 a = from.normalized();
  const Vec3 b = to.normalized();
  const double cosine = a.dot(b);
  Eigen::Quaterniond turn;
  if (cosine < -1.0 + 1e-12) {
    turn.w() = 0.0;
    turn.vec() = a.unitOrthogonal();
  } else {
    turn.w() = std::sqrt((1.0 + cosine) / 2.0);
    turn.vec() = a.cross(b) * (1.0 / (2.0 * turn.w()));
  }
  return turn;
}

}  // namespace vantage
