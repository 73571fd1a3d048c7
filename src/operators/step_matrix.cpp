// SPDX-License-Identifier: MIT
#include "operators/step_matrix.h"

#include <algorithm>
#include <limits>

namespace vantage {
namespace {

/// Place of entry (row, column) in a compressed matrix that has it.
int place_of(const Eigen::SparseMatrix<double>& M, int row, int column) {
  const int* rows = M.innerIndexPtr();
  const int* first = rows + M.outerIndexPtr()[column];
  const int* last = rows + M.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(first, last, row) - rows);
}

bool is_wide(int entries) {
  return entries > NormalMatrix::kWidestRow;
}

}  // namespace

bool NormalMatrix::fits(const Eigen::SparseMatrix<double>& L) {
  constexpr double kAlwaysAllowed = 2e6;
  constexpr double kMostAVertex = 500.0;
  const auto half_square = [](double width) { return 0.5 * width * (width + 1.0); };
  double entries = 0.0;
  for (Eigen::Index k = 0; k < L.cols(); ++k) {
    const int width = L.outerIndexPtr()[k + 1] - L.outerIndexPtr()[k];
    entries += is_wide(width) ? 0.0 : half_square(width);
  }
  const auto n = static_cast<double>(L.cols());
  constexpr double kMostOfAll = std::numeric_limits<int>::max();  // their places are int
  return std::min(entries, half_square(n)) <=
         std::min(std::max(kAlwaysAllowed, kMostAVertex * n), kMostOfAll);
}

NormalMatrix::NormalMatrix(const Eigen::SparseMatrix<double>& L)
    : A_(L.rows(), L.cols()), transposed_(static_cast<std::size_t>(L.nonZeros())) {
  const int n = static_cast<int>(L.cols());
  const int* start = L.outerIndexPtr();
  const int* rows = L.innerIndexPtr();
  for (int column = 0; column < n; ++column) {
    for (int e = start[column]; e < start[column + 1]; ++e) {
      transposed_[static_cast<std::size_t>(e)] = place_of(L, column, rows[e]);
    }
  }
  std::vector<int> starts{0};
  std::vector<int> inner;
  std::vector<int> seen(static_cast<std::size_t>(n), -1);
  for (int j = 0; j < n; ++j) {
    const std::size_t first = inner.size();
    for (int e = start[j]; e < start[j + 1]; ++e) {
      const int k = rows[e];
      for (int g = start[k]; g < start[k + 1] && !is_wide(start[k + 1] - start[k]); ++g) {
        const int i = rows[g];
        if (i >= j && seen[static_cast<std::size_t>(i)] != j) {
          seen[static_cast<std::size_t>(i)] = j;
          inner.push_back(i);
        }
      }
    }
    if (seen[static_cast<std::size_t>(j)] != j) {
      inner.push_back(j);  // all rows that name it are wide
    }
    std::sort(inner.begin() + static_cast<std::ptrdiff_t>(first), inner.end());
    starts.push_back(static_cast<int>(inner.size()));
  }
  A_.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(starts.begin(), starts.end(), A_.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), A_.innerIndexPtr());
}

Eigen::SparseMatrix<double>& NormalMatrix::assemble(const Eigen::SparseMatrix<double>& L,
                                                    const Eigen::VectorXd& row_weights,
                                                    const Eigen::VectorXd& diagonal) {
  const int n = static_cast<int>(L.cols());
  const int* start = L.outerIndexPtr();
  const int* rows = L.innerIndexPtr();
  const double* values = L.valuePtr();
  std::vector<double> column(static_cast<std::size_t>(n), 0.0);
  for (int j = 0; j < n; ++j) {
    // Column j of LᵀRL: sum over k of R_k L_kj times row k of L, whose entries stand at transposed_.
    for (int e = start[j]; e < start[j + 1]; ++e) {
      const int k = rows[e];
      const double factor = row_weights[k] * values[e];
      for (int g = start[k]; g < start[k + 1] && !is_wide(start[k + 1] - start[k]); ++g) {
        if (rows[g] >= j) {
          column[static_cast<std::size_t>(rows[g])] +=
              factor * values[transposed_[static_cast<std::size_t>(g)]];
        }
      }
    }
    for (int e = A_.outerIndexPtr()[j]; e < A_.outerIndexPtr()[j + 1]; ++e) {
      double& value = column[static_cast<std::size_t>(A_.innerIndexPtr()[e])];
      A_.valuePtr()[e] = value;
      value = 0.0;
    }
    A_.valuePtr()[A_.outerIndexPtr()[j]] += diagonal[j];  // rows ascend: the diagonal is first
  }
  return A_;
}

}  // namespace vantage
