// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "vantage/core/run_context.h"

namespace vantage {

/// Direct solver for symmetric positive definite systems whose pattern stays while values change.
/// The only place that knows which solver is used: our multifrontal Cholesky, whose bits do not
/// depend on threads, ordered by METIS or, where small, by minimum degree.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Symbolic analysis of the pattern of A. The lower triangle of A is used.
  /// \throw Cancelled; unusable then.
  void analyze(const Eigen::SparseMatrix<double>& A, const RunContext& run = {});

  /// Numeric factorisation; false if A is not positive definite in double precision, or if its factor
  /// is that of no surface: above 2e9 and 4 000 n^1.5 multiplications.
  /// \pre analyze() saw the same pattern. \throw Cancelled; unusable then.
  bool factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run = {});

  /// A⁻¹ B for the last matrix factorised. \pre factorize() returned true.
  [[nodiscard]] Eigen::MatrixX3d solve(const Eigen::MatrixX3d& B) const;

 private:
  struct Solver;
  std::shared_ptr<Solver> solver_;
};

}  // namespace vantage
