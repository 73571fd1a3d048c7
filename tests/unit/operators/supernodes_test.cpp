// SPDX-License-Identifier: MIT
#include "operators/supernodes.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/SparseCore>
#include <gtest/gtest.h>

#include "vantage/operators/cotangent_laplacian.h"

#include "operators/elimination_order.h"
#include "operators/sparse_cholesky.h"
#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse system_of(const TriMesh& mesh) {
  const Sparse L = cotangent_laplacian(mesh.positions, mesh.triangles);
  Sparse A = Sparse(L.transpose()) * L;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.coeffRef(i, i) += 1.0;
  }
  A.makeCompressed();
  return A;
}

/// Unknowns 0–1–2–…: eliminated in order, each column has its diagonal and one entry.
Sparse chain(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.5);
    if (i > 0) {
      entries.emplace_back(i, i - 1, -1.0);
    }
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(EliminationOrder, NamesEveryUnknownOnce) {
  const Sparse A = system_of(test::torus(1.0, 0.3, 24, 12));
  std::vector<int> order = elimination_order(A);
  std::sort(order.begin(), order.end());
  std::vector<int> all(static_cast<std::size_t>(A.rows()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

TEST(Supernodes, HoldEveryColumnOnceInRuns) {
  const Sparse A = system_of(test::torus(1.0, 0.3, 24, 12));
  const Supernodes nodes = find_supernodes(A, elimination_order(A));
  EXPECT_EQ(nodes.first_column.front(), 0);
  EXPECT_EQ(nodes.first_column.back(), static_cast<int>(A.cols()));
  EXPECT_TRUE(std::is_sorted(nodes.first_column.begin(), nodes.first_column.end()));
}

TEST(Supernodes, FindAPlaceForEveryRowAmongTheParents) {
  const Sparse A = system_of(test::torus(1.0, 0.3, 24, 12));
  const Supernodes nodes = find_supernodes(A, elimination_order(A));
  std::size_t wrong = 0;
  for (int s = 0; s < nodes.count(); ++s) {
    const auto n = static_cast<std::size_t>(s);
    const std::size_t own = nodes.row_start[n] + static_cast<std::size_t>(nodes.columns(s));
    for (std::size_t r = own; r < nodes.row_start[n + 1]; ++r) {
      const auto parent = static_cast<std::size_t>(nodes.parent[n]);
      const auto place = static_cast<std::size_t>(nodes.place_in_parent[r]);
      wrong += nodes.rows[nodes.row_start[parent] + place] == nodes.rows[r] ? 0 : 1;
    }
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(Supernodes, OfAChainFillNothingIn) {
  std::vector<int> order(40);
  std::iota(order.begin(), order.end(), 0);
  const Supernodes nodes = find_supernodes(chain(40), order);
  // Runs of up to four columns are joined whatever they fill in: at most 16 + 4 places each.
  EXPECT_LE(nodes.value_start.back(), 40U / 4U * (16U + 4U) + 20U);
}

TEST(SparseCholeskyFactorize, GivesTheSameBitsForAnyThreadCount) {
  const Sparse A = system_of(test::torus(1.0, 0.3, 200, 100));
  const Eigen::MatrixX3d B = Eigen::MatrixX3d::Ones(A.rows(), 3);
  const auto solution = [&](int threads) {
    const RunContext run{.report = {}, .stop = {}, .max_threads = threads};
    SparseCholesky solver;
    solver.analyze(A, run);
    EXPECT_TRUE(solver.factorize(A, run));
    return solver.solve(B);
  };
  const Eigen::MatrixX3d one = solution(1);
  EXPECT_EQ(test::with_many_threads([&] { return solution(3); }), one);
}

}  // namespace
}  // namespace vantage
