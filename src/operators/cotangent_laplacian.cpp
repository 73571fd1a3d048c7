// SPDX-License-Identifier: MIT
#include "vantage/operators/cotangent_laplacian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "operators/cotangent.h"
#include "operators/row_scaling.h"
#include "operators/step_matrix.h"

namespace vantage {
namespace {

using Entry = Eigen::Triplet<double, int>;

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

void finish_rows(Eigen::SparseMatrix<double>& L, const LaplacianLimits& limits) {
  // The diagonal last, from the summed weights, so that rows sum to zero to the last bit possible.
  Eigen::VectorXd row_sum = Eigen::VectorXd::Zero(L.rows());
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
  for (int i = 0; i < L.outerSize(); ++i) {
    L.coeffRef(i, i) = -row_sum(i);
  }
  scale_down_rows(L, limits.diagonal);
}

LaplacianAssembler::LaplacianAssembler(std::size_t vertices, std::span<const Triangle> triangles)
    : triangles_(triangles),
      L_(static_cast<Eigen::Index>(vertices), static_cast<Eigen::Index>(vertices)) {
  std::vector<Entry> entries;
  entries.reserve(6 * triangles.size() + vertices);
  for (const Triangle& t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto i = static_cast<int>(t[(corner + 1) % 3]);
      const auto j = static_cast<int>(t[(corner + 2) % 3]);
      entries.emplace_back(i, j, 0.0);
      entries.emplace_back(j, i, 0.0);
    }
  }
  for (int i = 0; i < static_cast<int>(vertices); ++i) {
    entries.emplace_back(i, i, 0.0);
  }
  L_.setFromTriplets(entries.begin(), entries.end());
  const auto place = [this](std::uint32_t row, std::uint32_t column) {
    return static_cast<int>(
        &L_.coeffRef(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) -
        L_.valuePtr());
  };
  slots_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    slots_.push_back({place(t[1], t[2]), place(t[2], t[1]), place(t[2], t[0]), place(t[0], t[2]),
                      place(t[0], t[1]), place(t[1], t[0])});
  }
}

const Eigen::SparseMatrix<double>& LaplacianAssembler::assemble(std::span<const Vec3> positions,
                                                                const LaplacianLimits& limits) {
  double* value = L_.valuePtr();
  std::fill(value, value + L_.nonZeros(), 0.0);
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const Triangle& t = triangles_[f];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double w = cotangent(positions[t[corner]], positions[t[(corner + 1) % 3]],
                                 positions[t[(corner + 2) % 3]], limits.cotangent);
      value[slots_[f][2 * corner]] += w;
      value[slots_[f][2 * corner + 1]] += w;
    }
  }
  finish_rows(L_, limits);
  return L_;
}

Eigen::SparseMatrix<double> cotangent_laplacian(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const LaplacianLimits& limits) {
  return LaplacianAssembler(positions.size(), triangles).assemble(positions, limits);
}

}  // namespace vantage
