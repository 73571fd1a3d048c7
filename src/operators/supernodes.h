// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

namespace vantage {

/// An index of Eigen's as one of a vector.
inline std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// The columns of a Cholesky factor in runs of equal structure, and the tree in which they depend
/// on each other. Columns are those of the permuted matrix, in post-order of the elimination tree.
/// Liu, "The Role of Elimination Trees in Sparse Factorization", 1990; runs that differ little are
/// joined as in Ashcraft, Grimes, "The Influence of Relaxed Supernode Partitions on the Multifrontal
/// Method", 1989.
struct Supernodes {
  std::vector<int> unknown_of_column{};  ///< Which unknown each column belongs to.
  std::vector<int> first_column{0};      ///< |S| + 1: supernode s has [first[s], first[s + 1]).
  std::vector<int> parent{};  ///< |S| supernodes, each above its children; −1 for roots.
  std::vector<int> first_descendant{};    ///< The subtree of s is [first_descendant[s], s].
  std::vector<std::size_t> row_start{0};  ///< |S| + 1 offsets into `rows`.
  std::vector<int> rows{};                ///< Rows of each supernode, ascending, own columns first.
  std::vector<int> place_in_parent{};     ///< For each of `rows` its place among the parent's; −1
                                          ///< for own columns.
  std::vector<std::size_t> value_start{0};    ///< |S| + 1 offsets of dense panels, rows × columns.
  std::vector<std::size_t> value_of_entry{};  ///< Where each lower entry of the matrix goes in the
                                              ///< panels, in the order in which it is stored.

  [[nodiscard]] int count() const { return static_cast<int>(parent.size()); }

  [[nodiscard]] int columns(int s) const { return first_column[at(s) + 1] - first_column[at(s)]; }

  [[nodiscard]] int height(int s) const {
    return static_cast<int>(row_start[at(s) + 1] - row_start[at(s)]);
  }
};

/// \param A     square, compressed; the lower triangle is used.
/// \param order which unknown goes k-th.
Supernodes find_supernodes(const Eigen::SparseMatrix<double>& A, const std::vector<int>& order);

}  // namespace vantage
