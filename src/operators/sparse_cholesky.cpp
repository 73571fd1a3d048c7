// SPDX-License-Identifier: MIT
#include "operators/sparse_cholesky.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parallel.h"
#include "operators/elimination_order.h"
#include "operators/supernodal_factor.h"
#include "operators/supernodes.h"

namespace vantage {
namespace {

/// Unknowns from which ordering, which cannot look at the stop token, may take longer than an
/// interrupt should.
constexpr Eigen::Index kInterruptibleFrom = 100'000;

/// Most multiplications for n unknowns: this, or so many times n^1.5. Surfaces take 50 to 100 times
/// n^1.5; soups of faces that share corners drawn by lot take n³ / 3, for which hours pass [ours].
constexpr double kAlwaysAllowed = 2e9;
constexpr double kMostWork = 4e3;

}  // namespace

struct SparseCholesky::Solver {
  std::optional<SupernodalFactor> factor{};

  void analyze(const Eigen::SparseMatrix<double>& A) {
    factor.reset();
    factor.emplace(find_supernodes(A, elimination_order(A)));
  }
};

SparseCholesky::SparseCholesky() : solver_(std::make_shared<Solver>()) {}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::analyze(const Eigen::SparseMatrix<double>& A, const RunContext& run) {
  if (A.rows() < kInterruptibleFrom) {
    solver_->analyze(A);
  } else {
    interruptible(run, [solver = solver_, copy = A] { solver->analyze(copy); });
  }
}

bool SparseCholesky::factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run) {
  const double most =
      std::max(kAlwaysAllowed, kMostWork * std::pow(static_cast<double>(A.rows()), 1.5));
  return solver_->factor->work() <= most && solver_->factor->factorize(A, run);
}

Eigen::MatrixX3d SparseCholesky::solve(const Eigen::MatrixX3d& B) const {
  return solver_->factor->solve(B);
}

}  // namespace vantage
