// SPDX-License-Identifier: MIT
#include "operators/position_solver.h"

namespace vantage {

bool PositionSolver::factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run) {
  if (!analysed_) {
    cholesky_.analyze(A, run);
    analysed_ = true;
  }
  return cholesky_.factorize(A, run);
}

Eigen::MatrixX3d PositionSolver::solve(const Eigen::MatrixX3d& B) const {
  return cholesky_.solve(B);
}

std::optional<std::vector<Vec3>> PositionSolver::solve(const Eigen::SparseMatrix<double>& A,
                                                       const Eigen::MatrixX3d& B,
                                                       const RunContext& run) {
  if (!factorize(A, run)) {
    return std::nullopt;
  }
  const Eigen::MatrixX3d X = solve(B);
  if (!X.allFinite()) {
    return std::nullopt;
  }
  std::vector<Vec3> positions(static_cast<std::size_t>(X.rows()));
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    positions[static_cast<std::size_t>(i)] = X.row(i).transpose();
  }
  return positions;
}

}  // namespace vantage
