// SPDX-License-Identifier: MIT
#include "operators/supernodal_factor.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "core/parallel.h"
#include "operators/dense_kernels.h"

namespace vantage {
namespace {

/// Subtrees of less than this share of all work are done side by side [ours: some dozen tasks].
constexpr double kTaskShare = 1.0 / 16.0;
/// Less work than this, in multiplications, is not worth a task.
constexpr double kLeastWork = 2e6;
/// Columns of a rest from which its update is shared among threads, and how many a task takes.
constexpr std::size_t kShared = 256;
constexpr std::size_t kChunk = 64;

using Eigen::Index;

/// Multiplications of one front: Σ of squared column heights.
double work_of(double height, double columns) {
  return columns * height * height - columns * columns * height + columns * columns * columns / 3.0;
}

/// Lower part of rest −= rows · rowsᵀ, rows being those of a panel below its own columns.
void subtract_square(ConstBlock rows, std::size_t depth, Eigen::MatrixXd& rest,
                     const RunContext& run) {
  const auto n = static_cast<std::size_t>(rest.cols());
  const auto chunk = [&](std::size_t begin, std::size_t end) {
    const ConstBlock from{rows.first + begin, rows.stride};
    subtract_product(rest.data() + begin + begin * n, n, from, from,
                     {n - begin, end - begin, depth}, true);
  };
  parallel_for(run, n, n < kShared ? n : kChunk, chunk);
}

}  // namespace

SupernodalFactor::SupernodalFactor(Supernodes nodes)
    : nodes_(std::move(nodes)), children_(nodes_.parent.size()), rests_(nodes_.parent.size()) {
  for (int s = 0; s < nodes_.count(); ++s) {
    if (nodes_.parent[at(s)] >= 0) {
      children_[at(nodes_.parent[at(s)])].push_back(s);
    }
  }
  plan_tasks();
}

void SupernodalFactor::plan_tasks() {
  std::vector<double> work(nodes_.parent.size(), 0.0);
  double all = 0.0;
  for (int s = 0; s < nodes_.count(); ++s) {
    const double own = work_of(nodes_.height(s), nodes_.columns(s));
    work[at(s)] += own;
    all += own;
    if (nodes_.parent[at(s)] >= 0) {
      work[at(nodes_.parent[at(s)])] += work[at(s)];
    }
  }
  work_ = all;
  const double least = std::max(kLeastWork, kTaskShare * all);
  for (int s = 0; s < nodes_.count(); ++s) {
    const int parent = nodes_.parent[at(s)];
    if (work[at(s)] > least) {
      top_.push_back(s);
    } else if (parent < 0 || work[at(parent)] > least) {
      subtrees_.push_back(s);
    }
  }
}

Eigen::Map<Eigen::MatrixXd> SupernodalFactor::panel(int s) {
  return {values_.data() + nodes_.value_start[at(s)], nodes_.height(s), nodes_.columns(s)};
}

Eigen::Map<const Eigen::MatrixXd> SupernodalFactor::panel(int s) const {
  return {values_.data() + nodes_.value_start[at(s)], nodes_.height(s), nodes_.columns(s)};
}

void SupernodalFactor::assemble_children(int s, Eigen::MatrixXd& rest) {
  auto own = panel(s);
  const int columns = nodes_.columns(s);
  for (const int child : children_[at(s)]) {
    Eigen::MatrixXd& left = rests_[at(child)];
    const int* place =
        nodes_.place_in_parent.data() + nodes_.row_start[at(child)] + at(nodes_.columns(child));
    for (Index j = 0; j < left.cols(); ++j) {
      const double* from = &left(0, j);
      const int column = place[j];
      // Places ascend, so what lies below the diagonal there lies below it here.
      const int shift = column < columns ? 0 : columns;
      double* to = column < columns ? &own(0, column) : &rest(0, column - columns);
      for (Index i = j; i < left.rows(); ++i) {
        to[place[i] - shift] += from[i];
      }
    }
    left.resize(0, 0);
  }
}

bool SupernodalFactor::factorize_front(int s, const RunContext& run) {
  const Index height = nodes_.height(s);
  const Index columns = nodes_.columns(s);
  Eigen::MatrixXd& rest = rests_[at(s)];
  rest.setZero(height - columns, height - columns);
  assemble_children(s, rest);
  run.check();
  double* own = panel(s).data();
  if (!factorize_panel(own, static_cast<std::size_t>(height), static_cast<std::size_t>(columns))) {
    return false;
  }
  if (height > columns) {
    subtract_square({own + columns, static_cast<std::size_t>(height)},
                    static_cast<std::size_t>(columns), rest, run);
  }
  return true;
}

bool SupernodalFactor::factorize(const Eigen::SparseMatrix<double>& A, const RunContext& run) {
  values_.assign(nodes_.value_start.back(), 0.0);
  std::size_t entry = 0;
  for (Index j = 0; j < A.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
      if (it.row() >= j) {
        values_[nodes_.value_of_entry[entry++]] = it.value();
      }
    }
  }
  std::atomic<bool> definite{true};
  const RunContext alone = run.alone();
  parallel_for(run, subtrees_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int root = subtrees_[i];
      for (int s = nodes_.first_descendant[at(root)]; s <= root && definite; ++s) {
        if (!factorize_front(s, alone)) {
          definite = false;
        }
      }
    }
  });
  for (const int s : top_) {
    if (!definite || !factorize_front(s, run)) {
      definite = false;
      break;
    }
  }
  for (Eigen::MatrixXd& rest : rests_) {
    rest.resize(0, 0);
  }
  return definite;
}

Eigen::MatrixX3d SupernodalFactor::solve(const Eigen::MatrixX3d& B) const {
  using Row = std::array<double, kRightSides>;
  const std::vector<int>& unknown = nodes_.unknown_of_column;
  std::vector<Row> X(unknown.size());
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    X[k] = {B(unknown[k], 0), B(unknown[k], 1), B(unknown[k], 2), 0.0};
  }
  std::vector<Row> front;
  const auto solve_front = [&](int s, const auto& with_panel) {
    const auto own = panel(s);
    const int* rows = nodes_.rows.data() + nodes_.row_start[at(s)];
    front.resize(static_cast<std::size_t>(own.rows()));
    for (std::size_t i = 0; i < front.size(); ++i) {
      front[i] = X[at(rows[i])];
    }
    with_panel(own.data(), front.size(), static_cast<std::size_t>(own.cols()),
               front.front().data());
    for (std::size_t i = 0; i < front.size(); ++i) {
      X[at(rows[i])] = front[i];
    }
  };
  for (int s = 0; s < nodes_.count(); ++s) {
    solve_front(s, solve_forward);
  }
  for (int s = nodes_.count(); s-- > 0;) {
    solve_front(s, solve_backward);
  }
  Eigen::MatrixX3d result(B.rows(), 3);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    result.row(unknown[k]) << X[k][0], X[k][1], X[k][2];
  }
  return result;
}

}  // namespace vantage
