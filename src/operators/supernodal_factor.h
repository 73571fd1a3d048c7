// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "vantage/core/run_context.h"

#include "operators/supernodes.h"

namespace vantage {

/// Multifrontal Cholesky factorisation (Duff, Reid 1983; Liu 1992): each supernode's columns are a
/// dense panel, and what it leaves for the columns above is a dense matrix that its parent takes up.
/// The order of all sums is fixed by the structure, so the bits depend neither on threads nor
/// on the processor.
class SupernodalFactor {
 public:
  explicit SupernodalFactor(Supernodes nodes);

  /// Multiplications that factorize() takes.
  [[nodiscard]] double work() const { return work_; }

  /// Factorises the matrix; false if it is not positive definite in double precision.
  /// \param A the pattern that `nodes` was found for. \throw Cancelled; unusable then.
  bool factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run);

  /// \pre factorize() returned true.
  [[nodiscard]] Eigen::MatrixX3d solve(const Eigen::MatrixX3d& B) const;

 private:
  void plan_tasks();
  bool factorize_front(int s, const RunContext& run);
  void assemble_children(int s, Eigen::MatrixXd& rest);
  Eigen::Map<Eigen::MatrixXd> panel(int s);
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> panel(int s) const;

  Supernodes nodes_;
  std::vector<std::vector<int>> children_{};
  double work_ = 0.0;
  std::vector<int> subtrees_{};           ///< Roots of subtrees that are done side by side.
  std::vector<int> top_{};                ///< Supernodes above them, children first.
  std::vector<double> values_{};          ///< All panels.
  std::vector<Eigen::MatrixXd> rests_{};  ///< What a supernode leaves for those above it.
};

}  // namespace vantage
