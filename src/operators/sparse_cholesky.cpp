// SPDX-License-Identifier: MIT
#include "operators/sparse_cholesky.h"

#include <iostream>  // Eigen 3.4's MetisSupport uses std::cerr without including it
#include <optional>

#include <Eigen/MetisSupport>
#include <Eigen/SparseCholesky>

#include "core/parallel.h"

namespace vantage {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using AmdSolver = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;
using MetisSolver = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::MetisOrdering<int>>;

/// Unknowns from which METIS's better ordering pays for its slower analysis: with some seven
/// factorisations an analysis, it halves the time on real models of 30 000 vertices.
constexpr Eigen::Index kMetisFrom = 8'000;
/// Unknowns from which one factorisation may take longer than an interrupt should.
constexpr Eigen::Index kInterruptibleFrom = 25'000;

}  // namespace

struct SparseCholesky::Solver {
  std::optional<AmdSolver> amd{};
  std::optional<MetisSolver> metis{};
  bool factorised = false;

  void analyze(const Matrix& A) {
    amd.reset();
    metis.reset();
    if (A.rows() < kMetisFrom) {
      amd.emplace().analyzePattern(A);
    } else {
      metis.emplace().analyzePattern(A);
    }
  }

  void factorize(const Matrix& A) {
    const auto run = [&](auto& solver) {
      solver.factorize(A);
      factorised = solver.info() == Eigen::Success;
    };
    amd ? run(*amd) : run(*metis);
  }
};

SparseCholesky::SparseCholesky() : solver_(std::make_shared<Solver>()) {}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::analyze(const Matrix& A, const RunContext& run) {
  if (A.rows() < kInterruptibleFrom) {
    solver_->analyze(A);
  } else {
    interruptible(run, [solver = solver_, copy = A] { solver->analyze(copy); });
  }
}

bool SparseCholesky::factorize(const Matrix& A, const RunContext& run) {
  if (A.rows() < kInterruptibleFrom) {
    solver_->factorize(A);
  } else {
    interruptible(run, [solver = solver_, copy = A] { solver->factorize(copy); });
  }
  return solver_->factorised;
}

Eigen::MatrixX3d SparseCholesky::solve(const Eigen::MatrixX3d& B) const {
  return solver_->amd ? Eigen::MatrixX3d(solver_->amd->solve(B))
                      : Eigen::MatrixX3d(solver_->metis->solve(B));
}

}  // namespace vantage
