// SPDX-License-Identifier: MIT
#include "operators/point_laplacian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "operators/cotangent.h"

namespace vantage {

Eigen::SparseMatrix<double, Eigen::RowMajor> point_laplacian(std::span<const Vec3> positions,
                                                             const PointRings& rings,
                                                             const LaplacianLimits& limits) {
  const auto n = static_cast<Eigen::Index>(positions.size());
  Eigen::SparseMatrix<double, Eigen::RowMajor> L(n, n);
  L.reserve(static_cast<Eigen::Index>(rings.neighbours.values.size() + positions.size()));
  std::vector<std::pair<std::uint32_t, double>> row;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    row.clear();
    for (const std::uint32_t j : rings.neighbours[i]) {
      row.emplace_back(j, 0.0);
    }
    std::sort(row.begin(), row.end());
    const auto add = [&row](std::uint32_t j, double w) {
      std::lower_bound(row.begin(), row.end(), j, [](const auto& entry, std::uint32_t key) {
        return entry.first < key;
      })->second += w;
    };
    rings.each_triangle(i, [&](std::uint32_t a, std::uint32_t b) {
      const Vec3& p = positions[i];
      add(a, cotangent(positions[b], p, positions[a], limits.cotangent));
      add(b, cotangent(positions[a], p, positions[b], limits.cotangent));
    });
    double sum = 0.0;
    for (auto& [j, w] : row) {
      w = limits.non_negative ? std::max(0.0, w) : w;
      sum += w;
    }
    row.emplace_back(i, -sum);
    std::sort(row.begin(), row.end());
    const double factor = std::abs(sum) > limits.diagonal ? limits.diagonal / std::abs(sum) : 1.0;
    L.startVec(i);
    for (const auto& [j, w] : row) {
      L.insertBack(i, j) = factor * w;
    }
  }
  L.finalize();
  return L;
}

}  // namespace vantage
