// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Dense>

#include "vantage/core/vec3.h"

namespace vantage {

/// Sum of squared distances to planes, weighted by area: xᵀ A x − 2 bᵀ x + c, about a near origin; A's
/// entries are `squares`.
struct Quadric {
  /// Pull of the optimal position to the middle of the edge, relative to the quadric's weight: solves
  /// what planes leave open.
  static constexpr double kMiddle = 1e-3;

  std::array<double, 6> squares{};  // xx xy xz yy yz zz
  Vec3 b = Vec3::Zero();
  double c = 0.0;
  double weight = 0.0;

  void add_plane(const Vec3& normal, const Vec3& point, double w) {
    const double d = normal.dot(point);
    squares[0] += w * normal.x() * normal.x();
    squares[1] += w * normal.x() * normal.y();
    squares[2] += w * normal.x() * normal.z();
    squares[3] += w * normal.y() * normal.y();
    squares[4] += w * normal.y() * normal.z();
    squares[5] += w * normal.z() * normal.z();
    b += w * d * normal;
    c += w * d * d;
    weight += w;
  }

  Quadric& operator*=(double factor) {
    for (double& a : squares) {
      a *= factor;
    }
    b *= factor;
    c *= factor;
    weight *= factor;
    return *this;
  }

  Quadric& operator+=(const Quadric& other) {
    for (std::size_t i = 0; i < squares.size(); ++i) {
      squares[i] += other.squares[i];
    }
    b += other.b;
    c += other.c;
    weight += other.weight;
    return *this;
  }

  [[nodiscard]] Vec3 times(const Vec3& x) const {
    return {squares[0] * x.x() + squares[1] * x.y() + squares[2] * x.z(),
            squares[1] * x.x() + squares[3] * x.y() + squares[4] * x.z(),
            squares[2] * x.x() + squares[4] * x.y() + squares[5] * x.z()};
  }

  [[nodiscard]] double error(const Vec3& x) const {
    return std::max(0.0, x.dot(times(x)) - 2.0 * b.dot(x) + c);
  }

  /// The point of least error, drawn weakly to `middle`.
  [[nodiscard]] Vec3 best_point(const Vec3& middle) const {
    const double pull = kMiddle * weight;
    Eigen::Matrix3d M;
    M.col(0) = Vec3(squares[0] + pull, squares[1], squares[2]);
    M.col(1) = Vec3(squares[1], squares[3] + pull, squares[4]);
    M.col(2) = Vec3(squares[2], squares[4], squares[5] + pull);
    const Vec3 x = middle + M.inverse() * (b - times(middle));
    return x.allFinite() ? x : middle;
  }
};

}  // namespace vantage
