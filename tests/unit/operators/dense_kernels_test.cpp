// SPDX-License-Identifier: MIT
#include "operators/dense_kernels.h"

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace vantage {
namespace {

/// A matrix of numbers without a pattern, in [−1, 1].
Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd M(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      M(i, j) = std::sin(static_cast<double>(i * i + 7 * i * j + 3 * j + 1));
    }
  }
  return M;
}

ConstBlock block(const Eigen::MatrixXd& M) {
  return {M.data(), static_cast<std::size_t>(M.rows())};
}

/// The largest difference between subtract_product() and Eigen's product.
double product_error(Eigen::Index rows, Eigen::Index columns, Eigen::Index depth) {
  const Eigen::MatrixXd A = numbers(rows, depth);
  const Eigen::MatrixXd B = numbers(columns, depth);
  Eigen::MatrixXd C = numbers(rows, columns);
  const Eigen::MatrixXd expected = C - A * B.transpose();
  subtract_product(C.data(), static_cast<std::size_t>(rows), block(A), block(B),
                   {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns),
                    static_cast<std::size_t>(depth)},
                   false);
  return (C - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

TEST(SubtractProduct, IsThatOfMatricesForWholeTiles) {
  EXPECT_LT(product_error(16, 8, 5), 1e-14);
}

TEST(SubtractProduct, IsThatOfMatricesForBordersAndDepthsOverOneSlice) {
  // 200 products of at most 1 each, rounded at 2⁻⁵³.
  EXPECT_LT(product_error(21, 7, 200), 200 * 200 * 0x1p-53);
}

TEST(SubtractProduct, IsThatOfMatricesForAllRestsOfATile) {
  for (Eigen::Index rows = 1; rows <= 17; ++rows) {
    for (Eigen::Index columns = 1; columns <= 5; ++columns) {
      EXPECT_LT(product_error(rows, columns, 3), 1e-14) << rows << " × " << columns;
    }
  }
}

TEST(SubtractProduct, LeavesTheUpperTilesAloneIfOnlyTheLowerAreWanted) {
  const Eigen::MatrixXd A = numbers(24, 3);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(24, 24);
  subtract_product(C.data(), 24, block(A), block(A), {24, 24, 3}, true);
  EXPECT_EQ(C(0, 23), 0.0);
  const Eigen::MatrixXd expected = -A * A.transpose();
  const Eigen::MatrixXd difference = C - expected;
  EXPECT_LT(difference.triangularView<Eigen::Lower>()
                .toDenseMatrix()
                .cwiseAbs()
                .maxCoeff<Eigen::PropagateNaN>(),
            1e-15);
}

TEST(FactorizePanel, IsTheCholeskyFactorOfTheWholeMatrix) {
  const Eigen::MatrixXd R = numbers(50, 50);
  const Eigen::MatrixXd M = R * R.transpose() + 50.0 * Eigen::MatrixXd::Identity(50, 50);
  Eigen::MatrixXd panel = M.leftCols(37);
  ASSERT_TRUE(factorize_panel(panel.data(), 50, 37));
  const Eigen::MatrixXd expected = M.llt().matrixL();
  const Eigen::MatrixXd difference = panel - expected.leftCols(37);
  EXPECT_LT(difference.triangularView<Eigen::Lower>()
                .toDenseMatrix()
                .cwiseAbs()
                .maxCoeff<Eigen::PropagateNaN>(),
            1e-12);
}

TEST(FactorizePanel, SaysThatAPivotIsNotPositive) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(20, 20);
  M(18, 18) = -1.0;
  EXPECT_FALSE(factorize_panel(M.data(), 20, 20));
}

TEST(FactorizePanel, SaysThatAPivotIsNoNumber) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(4, 4);
  M(2, 2) = std::nan("");
  EXPECT_FALSE(factorize_panel(M.data(), 4, 4));
}

using RightSides = Eigen::Matrix<double, Eigen::Dynamic, kRightSides, Eigen::RowMajor>;

TEST(SolvePanel, IsTheTriangularSolveOfItsTopAndTheProductOfTheRest) {
  for (Eigen::Index columns = 1; columns <= 9; ++columns) {  // blocks of columns, whole and in part
    const Eigen::Index height = columns + 6;
    Eigen::MatrixXd panel = numbers(height, columns);
    panel.diagonal().array() += 3.0;
    const auto top = panel.topRows(columns);
    const auto rest = panel.bottomRows(6);
    const auto h = static_cast<std::size_t>(height);
    const auto c = static_cast<std::size_t>(columns);
    const RightSides given = numbers(height, kRightSides);

    RightSides forward = given;
    solve_forward(panel.data(), h, c, forward.data());
    RightSides expected = given;
    expected.topRows(columns) = top.triangularView<Eigen::Lower>().solve(given.topRows(columns));
    expected.bottomRows(6) -= rest * expected.topRows(columns);
    EXPECT_LT((forward - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-13) << columns;

    RightSides backward = given;
    solve_backward(panel.data(), h, c, backward.data());
    expected = given;
    const RightSides left = given.topRows(columns) - rest.transpose() * given.bottomRows(6);
    expected.topRows(columns) = top.transpose().triangularView<Eigen::Upper>().solve(left);
    EXPECT_LT((backward - expected).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-13) << columns;
  }
}

}  // namespace
}  // namespace vantage
