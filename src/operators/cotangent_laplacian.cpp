// SPDX-License-Identifier: MIT
#include "vantage/operators/cotangent_laplacian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace vantage {
namespace {

using Entry = Eigen::Triplet<double, int>;

/// Cotangent of the angle at `apex` in the triangle apex, p, q; 0 if the triangle has no area.
double cotangent(const Vec3& apex, const Vec3& p, const Vec3& q, double limit) {
  const Vec3 u = p - apex;
  const Vec3 v = q - apex;
  const double twice_area = u.cross(v).norm();
  if (!(twice_area > 0.0)) {
    return 0.0;
  }
  return std::clamp(u.dot(v) / twice_area, -limit, limit);
}

void scale_down_rows(Eigen::SparseMatrix<double>& L, double limit) {
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(L.rows());
  bool any = false;
  for (int i = 0; i < L.outerSize(); ++i) {
    const double diagonal = std::abs(L.coeff(i, i));
    if (diagonal > limit) {
      factor(i) = limit / diagonal;
      any = true;
    }
  }
  if (any) {
    for (int column = 0; column < L.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L, column); entry; ++entry) {
        entry.valueRef() *= factor(entry.row());
      }
    }
  }
}

}  // namespace

Eigen::SparseMatrix<double> cotangent_laplacian(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const LaplacianLimits& limits) {
  const auto n = static_cast<Eigen::Index>(positions.size());
  std::vector<Entry> entries;
  entries.reserve(6 * triangles.size() + positions.size());
  for (const Triangle& t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t i = t[(corner + 1) % 3];
      const std::uint32_t j = t[(corner + 2) % 3];
      const double w =
          cotangent(positions[t[corner]], positions[i], positions[j], limits.cotangent);
      entries.emplace_back(static_cast<int>(i), static_cast<int>(j), w);
      entries.emplace_back(static_cast<int>(j), static_cast<int>(i), w);
    }
  }
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 0.0);
  }
  Eigen::SparseMatrix<double> L(n, n);
  L.setFromTriplets(entries.begin(), entries.end());

  // The diagonal last, from the summed weights, so that rows sum to zero to the last bit possible.
  Eigen::VectorXd row_sum = Eigen::VectorXd::Zero(n);
  for (int column = 0; column < L.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(L, column); entry; ++entry) {
      if (entry.row() != entry.col()) {
        if (limits.non_negative) {
          entry.valueRef() = std::max(0.0, entry.value());
        }
        row_sum(entry.row()) += entry.value();
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    L.coeffRef(i, i) = -row_sum(i);
  }
  scale_down_rows(L, limits.diagonal);
  return L;
}

}  // namespace vantage
