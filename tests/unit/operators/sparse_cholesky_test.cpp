// SPDX-License-Identifier: MIT
#include "operators/sparse_cholesky.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "vantage/operators/cotangent_laplacian.h"

#include "core/random.h"
#include "operators/step_matrix.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// L² + shift on a torus.
Sparse system_of_torus(double shift) {
  const TriMesh mesh = test::torus(1.0, 0.3, 16, 10);
  const Sparse L = cotangent_laplacian(mesh.positions, mesh.triangles);
  Sparse A = Sparse(L.transpose()) * L;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.coeffRef(i, i) += shift;
  }
  return A;
}

Eigen::MatrixX3d right_side(Eigen::Index n) {
  Eigen::MatrixX3d B(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    B.row(i) << std::sin(x), std::cos(2.0 * x), 1.0;
  }
  return B;
}

/// Tridiagonal 2, −1: positive definite at any size.
Sparse chain(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.5);
    if (i > 0) {
      entries.emplace_back(i, i - 1, -1.0);
      entries.emplace_back(i - 1, i, -1.0);
    }
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(SparseCholeskySolve, AgreesWithADenseFactorisation) {
  const Sparse A = system_of_torus(0.1);
  SparseCholesky solver;
  solver.analyze(A);
  ASSERT_TRUE(solver.factorize(A));
  const Eigen::MatrixX3d B = right_side(A.rows());
  const Eigen::MatrixX3d expected = Eigen::MatrixXd(A).llt().solve(B);
  const double error = (solver.solve(B) - expected).norm() / expected.norm();
  ::testing::Test::RecordProperty("relative_error", std::to_string(error * 1e15) + "e-15");
  // Condition about 10⁴: 12 digits are left.
  EXPECT_LE(error, 1e-11);
}

TEST(SparseCholeskySolve, ReusesAnAnalysisForOtherValues) {
  SparseCholesky solver;
  solver.analyze(system_of_torus(1.0));
  for (const double shift : {1.0, 3.0}) {
    const Sparse A = system_of_torus(shift);
    ASSERT_TRUE(solver.factorize(A));
    const Eigen::MatrixX3d B = right_side(A.rows());
    EXPECT_LE((A * solver.solve(B) - B).norm(), 1e-11 * B.norm());
  }
}

TEST(SparseCholeskyFactorize, SaysWhenTheMatrixIsNotPositiveDefinite) {
  SparseCholesky solver;
  const Sparse A = system_of_torus(-1.0);  // L² has the eigenvalue 0
  solver.analyze(A);
  EXPECT_FALSE(solver.factorize(A));
}

TEST(SparseCholeskyFactorize, RefusesWhatFillsUpLikeNoSurface) {
  // A soup of faces with shared corners: each unknown is joined to eight that were drawn by lot.
  constexpr int kUnknowns = 3000;
  Pcg32 random(5);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < kUnknowns; ++i) {
    entries.emplace_back(i, i, 100.0);
    for (int k = 0; k < 8; ++k) {
      const int j = static_cast<int>(random.uniform() * kUnknowns);
      entries.emplace_back(i, j, -1.0);
      entries.emplace_back(j, i, -1.0);
    }
  }
  Sparse A(kUnknowns, kUnknowns);
  A.setFromTriplets(entries.begin(), entries.end());
  SparseCholesky cholesky;
  cholesky.analyze(A);
  EXPECT_FALSE(cholesky.factorize(A));
}

TEST(NormalMatrix, StaysSparseAtAVertexOfThousandsOfNeighbours) {
  // A book: pages that share one edge. The squares of its ends' rows alone have two million entries.
  constexpr std::uint32_t kPages = 2000;
  TriMesh book{.positions = {{0, 0, 0}, {0, 0, 1}}, .triangles = {}};
  for (std::uint32_t page = 0; page < kPages; ++page) {
    book.positions.emplace_back(std::cos(0.003 * page), std::sin(0.003 * page), 0.5);
    book.triangles.push_back({0, 1, page + 2});
  }
  const Sparse L = cotangent_laplacian(book.positions, book.triangles);
  NormalMatrix normal(L);
  const auto n = static_cast<Eigen::Index>(book.positions.size());
  Eigen::VectorXd rows = Eigen::VectorXd::Ones(n);
  const Sparse A = normal.assemble(L, rows, Eigen::VectorXd::Ones(n));
  EXPECT_LT(A.nonZeros(), 10 * n);
  rows.head(2).setZero();  // the wide rows count as nothing, the others as ever
  Sparse expected = Sparse(L.transpose()) * rows.asDiagonal() * L;
  for (Eigen::Index i = 0; i < n; ++i) {
    expected.coeffRef(i, i) += 1.0;
  }
  const Eigen::MatrixXd lower = Eigen::MatrixXd(expected).triangularView<Eigen::Lower>();
  EXPECT_LT((Eigen::MatrixXd(A) - lower).norm(), 1e-9 * lower.norm());
}

/// The full pattern of n vertices, each with `neighbours` others behind it.
Sparse band_of(int n, int neighbours) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    for (int k = -neighbours / 2; k <= neighbours / 2; ++k) {
      entries.emplace_back((i + k + n) % n, i, 1.0);
    }
  }
  Sparse L(n, n);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

TEST(NormalMatrix, FitsUnlessItsEntriesAreAsManyAsOfFacesByLot) {
  EXPECT_TRUE(NormalMatrix::fits(band_of(20000, 30)));
  EXPECT_TRUE(NormalMatrix::fits(band_of(1500, 800)));  // all of 1500² / 2 entries are few
  EXPECT_FALSE(NormalMatrix::fits(band_of(8000, 220)));
}

/// Places of entries are counted in int.
TEST(NormalMatrix, FitsNotWhereItsEntriesCannotBeCounted) {
  const auto rows_of_31 = [](int n) {
    Sparse L(n, n);
    for (int column = 0; column <= n; ++column) {
      L.outerIndexPtr()[column] = 31 * column;  // all that is looked at
    }
    return L;
  };
  EXPECT_TRUE(NormalMatrix::fits(rows_of_31(4'300'000)));  // 31 · 32 / 2 a row, below 2³¹
  EXPECT_FALSE(NormalMatrix::fits(rows_of_31(4'400'000)));
}

TEST(SparseCholeskyFactorize, WorksAgainAfterAFailure) {
  SparseCholesky solver;
  solver.analyze(system_of_torus(1.0));
  ASSERT_FALSE(solver.factorize(system_of_torus(-1.0)));
  EXPECT_TRUE(solver.factorize(system_of_torus(1.0)));
}

TEST(SparseCholeskySolve, HandlesSystemsOnBothSidesOfTheChangeOfOrdering) {
  for (const int n : {7'999, 8'000, 60'000}) {
    const Sparse A = chain(n);
    SparseCholesky solver;
    solver.analyze(A);
    ASSERT_TRUE(solver.factorize(A));
    const Eigen::MatrixX3d X = right_side(n);
    EXPECT_LE((solver.solve(A * X) - X).norm(), 1e-13 * X.norm()) << n;
  }
}

TEST(SparseCholeskySolve, LeavesNoResidualOnALargeSheet) {
  const TriMesh mesh = test::sheet(1.0, 1.0, 230);  // 53 361 vertices: ordered by METIS
  const Sparse L = cotangent_laplacian(mesh.positions, mesh.triangles);
  Sparse identity(L.rows(), L.cols());
  identity.setIdentity();
  const Sparse A = identity - L;
  SparseCholesky solver;
  solver.analyze(A);
  ASSERT_TRUE(solver.factorize(A));
  const Eigen::MatrixX3d B = right_side(A.rows());
  // Eigenvalues lie between 1 and 1 + 8 · 2, so that residual and error are alike.
  EXPECT_LE((A * solver.solve(B) - B).norm(), 1e-14 * B.norm());
}

TEST(SparseCholeskyFactorize, SaysSoForLargeSystemsToo) {
  Sparse A = chain(60'000);
  A.coeffRef(30'000, 30'000) = -2.5;
  SparseCholesky solver;
  solver.analyze(A);
  EXPECT_FALSE(solver.factorize(A));
}

TEST(SparseCholeskySolve, SurvivesBeingMoved) {
  const Sparse A = chain(10);
  SparseCholesky solver;
  solver.analyze(A);
  ASSERT_TRUE(solver.factorize(A));
  const SparseCholesky moved = std::move(solver);
  const Eigen::MatrixX3d X = right_side(10);
  EXPECT_LE((moved.solve(A * X) - X).norm(), 1e-14 * X.norm());
}

}  // namespace
}  // namespace vantage
