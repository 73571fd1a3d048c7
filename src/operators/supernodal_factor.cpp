// SPDX-License-Identifier: MIT
#include "operators/supernodal_factor.h"

#include <algorithm>
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

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

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
  const RunContext alone{.report = {}, .stop = run.stop, .max_threads = 1};
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
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const std::vector<int>& unknown = nodes_.unknown_of_column;
  Rows X(B.rows(), 3);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    X.row(static_cast<Index>(k)) = B.row(unknown[k]);
  }
  for (int s = 0; s < nodes_.count(); ++s) {
    const auto own = panel(s);
    const int* rows = nodes_.rows.data() + nodes_.row_start[at(s)];
    for (Index j = 0; j < own.cols(); ++j) {
      const Eigen::RowVector3d x = X.row(rows[j]) / own(j, j);
      X.row(rows[j]) = x;
      for (Index i = j + 1; i < own.rows(); ++i) {
        X.row(rows[i]) -= own(i, j) * x;
      }
    }
  }
  for (int s = nodes_.count(); s-- > 0;) {
    const auto own = panel(s);
    const int* rows = nodes_.rows.data() + nodes_.row_start[at(s)];
    for (Index j = own.cols(); j-- > 0;) {
      Eigen::RowVector3d x = X.row(rows[j]);
      for (Index i = j + 1; i < own.rows(); ++i) {
        x -= own(i, j) * X.row(rows[i]);
      }
      X.row(rows[j]) = x / own(j, j);
    }
  }
  Eigen::MatrixX3d result(B.rows(), 3);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    result.row(unknown[k]) = X.row(static_cast<Index>(k));
  }
  return result;
}

}  // namespace vantage
