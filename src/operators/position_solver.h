// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"

#include "operators/sparse_cholesky.h"

namespace vantage {

/// Solves A X = B for points, for matrices of one pattern: that is analysed the first time.
class PositionSolver {
 public:
  /// \param A its lower triangle is used; the pattern of the first call.
  /// \return false if it is not positive definite. \throw Cancelled; unusable then.
  bool factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run);

  /// X of the matrix that was factorised last. \param B |V| × 3.
  [[nodiscard]] Eigen::MatrixX3d solve(const Eigen::MatrixX3d& B) const;

  /// |V| points, or nothing if A is not positive definite or the result is not finite.
  /// \param A its lower triangle is used; the pattern of the first call. \param B |V| × 3.
  /// \throw Cancelled; unusable then.
  std::optional<std::vector<Vec3>> solve(const Eigen::SparseMatrix<double>& A,
                                         const Eigen::MatrixX3d& B, const RunContext& run);

 private:
  SparseCholesky cholesky_{};
  bool analysed_ = false;
};

}  // namespace vantage
