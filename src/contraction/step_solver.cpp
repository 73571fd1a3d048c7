// SPDX-License-Identifier: MIT
#include "contraction/step_solver.h"

#include <cstddef>
#include <utility>

#include "vantage/operators/cotangent_laplacian.h"

#include "contraction/step_limits.h"
#include "operators/intrinsic_delaunay.h"

namespace vantage {
namespace {

/// A correction of more than this share of the solution says that neither is worth much: a step as
/// defined counts as not solved, and regularised ones are tried; of those the solution stands as it
/// is, as there may be none better [ours].
constexpr double kTrusted = 1e-2;

/// Rows are read as wholes.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// −½ the gradient of |W_L L (x + d)|² + Σ W_H,i² |d_i|² at the displacement d.
class Pull {
 public:
  /// \param L a Laplacian: its rows add up to zero. \param rows W_L² of each row.
  /// \param held W_H² of each vertex. All must outlive this.
  Pull(const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& rows,
       const Eigen::VectorXd& held)
      : L_(L), rows_(rows), held_(held) {}

  /// \param moved x + d.
  [[nodiscard]] Eigen::MatrixX3d at(const Positions& moved, const Eigen::MatrixX3d& d) const {
    // By differences of positions: rounding then is relative to edges, not to the model.
    Positions bent = Positions::Zero(moved.rows(), 3);
    for (int j = 0; j < L_.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L_, j); entry; ++entry) {
        bent.row(entry.row()) += entry.value() * (moved.row(j) - moved.row(entry.row()));
      }
    }
    bent.array().colwise() *= rows_.array();
    Eigen::MatrixX3d pull(moved.rows(), 3);
    for (int j = 0; j < L_.outerSize(); ++j) {
      Eigen::RowVector3d sum = held_[j] * d.row(j);
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L_, j); entry; ++entry) {
        sum += entry.value() * bent.row(entry.row());
      }
      pull.row(j) = -sum;
    }
    return pull;
  }

 private:
  const Eigen::SparseMatrix<double>& L_;
  const Eigen::VectorXd& rows_;
  const Eigen::VectorXd& held_;
};

/// Corrected semi-normal equations (Björck, "Stability analysis of the method of seminormal
/// equations", 1987): the factor is that of the normal equations, the residual that of the
/// least-squares problem, which they would square away.
std::optional<std::vector<Vec3>> refined(const std::vector<Vec3>& start, const Pull& pull,
                                         const PositionSolver& system, int regularisation) {
  const auto n = static_cast<Eigen::Index>(start.size());
  Positions x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    x.row(i) = start[static_cast<std::size_t>(i)].transpose();
  }
  Eigen::MatrixX3d d = system.solve(pull.at(x, Eigen::MatrixX3d::Zero(n, 3)));
  const Eigen::MatrixX3d correction = system.solve(pull.at(x + d, d));
  if (correction.norm() <= kTrusted * d.norm()) {
    d += correction;
  } else if (regularisation == kAsDefined) {
    return std::nullopt;
  }
  if (!d.allFinite()) {
    return std::nullopt;
  }
  std::vector<Vec3> moved(start);
  for (Eigen::Index i = 0; i < n; ++i) {
    moved[static_cast<std::size_t>(i)] += d.row(i).transpose();
  }
  return moved;
}

/// Factorises the normal equations of L and solves them.
std::optional<std::vector<Vec3>> solved(const Eigen::SparseMatrix<double>& L, NormalMatrix& normal,
                                        PositionSolver& system, const std::vector<Vec3>& start,
                                        Eigen::VectorXd rows, Eigen::VectorXd held,
                                        int regularisation, const RunContext& run) {
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    // L has a symmetric pattern, so that columns are as wide as rows.
    if (L.outerIndexPtr()[i + 1] - L.outerIndexPtr()[i] > NormalMatrix::kWidestRow) {
      rows[i] = 0.0;
    }
  }
  Eigen::SparseMatrix<double>& A = normal.assemble(L, rows, held);
  const double shift = shift_of(A.diagonal().maxCoeff(), regularisation);
  if (shift > 0.0) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      A.coeffRef(i, i) += shift;
    }
    held.array() += shift;
  }
  if (!system.factorize(A, run)) {
    return std::nullopt;
  }
  return refined(start, Pull(L, rows, held), system, regularisation);
}

}  // namespace

StepSolver::StepSolver(const TriMesh& start, const EvenShares& shares)
    : shares_(shares), laplacian_(start.positions.size(), start.triangles) {}

IntrinsicSystem& StepSolver::intrinsic_of(const TriMesh& now, const LaplacianLimits& limits) {
  if (!intrinsic_ || intrinsic_->positions != now.positions || intrinsic_->limits != limits) {
    intrinsic_.emplace();
    intrinsic_->positions = now.positions;
    intrinsic_->limits = limits;
    intrinsic_->laplacian = intrinsic_laplacian(now.positions, now.triangles, limits);
    if (NormalMatrix::fits(intrinsic_->laplacian)) {
      intrinsic_->normal.emplace(intrinsic_->laplacian);
    }
  }
  return *intrinsic_;
}

std::optional<std::vector<Vec3>> StepSolver::solve(const TriMesh& now, double W_L,
                                                   const std::vector<double>& W_H,
                                                   const ContractionOptions& options,
                                                   const StepVariant& variant,
                                                   const RunContext& run) {
  const auto n = static_cast<Eigen::Index>(now.positions.size());
  Eigen::VectorXd rows(n);
  Eigen::VectorXd held(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto v = static_cast<std::size_t>(i);
    const double count = shares_.empty() ? 1.0 : shares_.count[v];
    rows[i] = W_L * W_L / count;
    held[i] = count * W_H[v] * W_H[v];
  }
  const LaplacianLimits limits = limits_of(options, variant.regularisation);
  if (variant.intrinsic) {
    IntrinsicSystem& own = intrinsic_of(now, limits);
    return own.normal ? solved(own.laplacian, *own.normal, own.solver, now.positions,
                               std::move(rows), std::move(held), variant.regularisation, run)
                      : std::nullopt;
  }
  const Eigen::SparseMatrix<double>& L = laplacian_.assemble(now.positions, limits);
  if (!normal_) {
    if (!NormalMatrix::fits(L)) {
      return std::nullopt;
    }
    normal_.emplace(L);
  }
  return solved(L, *normal_, system_, now.positions, std::move(rows), std::move(held),
                variant.regularisation, run);
}

}  // namespace vantage
