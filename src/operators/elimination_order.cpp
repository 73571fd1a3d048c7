// SPDX-License-Identifier: MIT
#include "operators/elimination_order.h"

#include <cstddef>
#include <iostream>  // Eigen 3.4's MetisSupport uses std::cerr without including it
#include <mutex>

#include <Eigen/MetisSupport>
#include <Eigen/OrderingMethods>

namespace vantage {
namespace {

/// Unknowns from which METIS's slower analysis pays: at 43 000 it leaves 3 % less fill than minimum
/// degree and takes five times as long, at 134 000 it saves half of the work (bench/solver_table.cpp).
constexpr Eigen::Index kDissectFrom = 60'000;

}  // namespace

std::vector<int> elimination_order(const Eigen::SparseMatrix<double>& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  if (A.rows() < kDissectFrom) {
    Eigen::AMDOrdering<int>()(A.selfadjointView<Eigen::Lower>(), order);
  } else {
    const Eigen::SparseMatrix<double> both = A.selfadjointView<Eigen::Lower>();
    // METIS draws from the process's one random sequence, which it begins anew.
    static std::mutex turn;
    const std::lock_guard lock(turn);
    Eigen::MetisOrdering<int>()(both, order);
  }
  const auto* unknowns = order.indices().data();
  return {unknowns, unknowns + static_cast<std::size_t>(A.rows())};
}

}  // namespace vantage
