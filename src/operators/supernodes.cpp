// SPDX-License-Identifier: MIT
#include "operators/supernodes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vantage {
namespace {

/// A supernode is joined with the one above while it has at most so many columns and at most this
/// share of zeros; any number of columns at the last share (as CHOLMOD does).
constexpr int kAlwaysJoined = 4;
constexpr int kNarrow = 16;
constexpr double kNarrowZeros = 0.8;
constexpr int kMedium = 48;
constexpr double kMediumZeros = 0.1;
constexpr double kWideZeros = 0.05;

/// For each column the rows above its diagonal, ascending within reason (any order will do).
struct UpperPattern {
  std::vector<std::size_t> offsets{};
  std::vector<int> rows{};
};

UpperPattern upper_pattern(const Eigen::SparseMatrix<double>& A,
                           const std::vector<int>& column_of) {
  UpperPattern upper;
  upper.offsets.assign(column_of.size() + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
        if (it.row() > j) {
          const int a = column_of[static_cast<std::size_t>(it.row())];
          const int b = column_of[static_cast<std::size_t>(j)];
          visit(std::min(a, b), std::max(a, b));
        }
      }
    }
  };
  for_each([&](int, int column) { ++upper.offsets[at(column) + 1]; });
  std::partial_sum(upper.offsets.begin(), upper.offsets.end(), upper.offsets.begin());
  upper.rows.resize(upper.offsets.back());
  std::vector<std::size_t> next(upper.offsets.begin(), upper.offsets.end() - 1);
  for_each([&](int row, int column) { upper.rows[next[at(column)]++] = row; });
  return upper;
}

std::vector<int> elimination_tree(const UpperPattern& upper) {
  const int n = static_cast<int>(upper.offsets.size()) - 1;
  std::vector<int> parent(at(n), -1);
  std::vector<int> ancestor(at(n), -1);
  for (int j = 0; j < n; ++j) {
    for (std::size_t e = upper.offsets[at(j)]; e < upper.offsets[at(j) + 1]; ++e) {
      for (int i = upper.rows[e]; i != -1 && i < j;) {
        const int next = std::exchange(ancestor[at(i)], j);
        if (next == -1) {
          parent[at(i)] = j;
        }
        i = next;
      }
    }
  }
  return parent;
}

/// Children before their parents, subtrees in one run; among children the lower first.
std::vector<int> post_order(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  std::vector<int> child(at(n), -1);
  std::vector<int> sibling(at(n), -1);
  std::vector<int> stack;
  for (int i = n - 1; i >= 0; --i) {
    if (parent[at(i)] >= 0) {
      sibling[at(i)] = std::exchange(child[at(parent[at(i)])], i);
    } else {
      stack.push_back(i);
    }
  }
  std::vector<int> order;
  order.reserve(parent.size());
  while (!stack.empty()) {
    const int top = stack.back();
    if (child[at(top)] >= 0) {
      const int next = child[at(top)];
      child[at(top)] = sibling[at(next)];
      stack.push_back(next);
    } else {
      order.push_back(top);
      stack.pop_back();
    }
  }
  return order;
}

/// Entries of each column of the factor, the diagonal counted.
std::vector<int> column_counts(const UpperPattern& upper, const std::vector<int>& parent) {
  std::vector<int> count(parent.size(), 1);
  std::vector<int> seen(parent.size(), -1);
  for (int row = 0; row < static_cast<int>(parent.size()); ++row) {
    seen[at(row)] = row;
    for (std::size_t e = upper.offsets[at(row)]; e < upper.offsets[at(row) + 1]; ++e) {
      for (int k = upper.rows[e]; seen[at(k)] != row; k = parent[at(k)]) {
        seen[at(k)] = row;
        ++count[at(k)];
      }
    }
  }
  return count;
}

/// Runs of columns of equal structure below the diagonal: their first columns, and the end.
std::vector<int> fundamental_runs(const std::vector<int>& parent, const std::vector<int>& count) {
  std::vector<int> children(parent.size(), 0);
  for (const int p : parent) {
    if (p >= 0) {
      ++children[at(p)];
    }
  }
  std::vector<int> first{0};
  for (int j = 1; j < static_cast<int>(parent.size()); ++j) {
    const bool same =
        parent[at(j - 1)] == j && count[at(j - 1)] == count[at(j)] + 1 && children[at(j)] == 1;
    if (!same) {
      first.push_back(j);
    }
  }
  first.push_back(static_cast<int>(parent.size()));
  return first;
}

/// Joins runs with the one above where that stores few zeros; returns their first columns and the end.
std::vector<int> relaxed_runs(const std::vector<int>& first, const std::vector<int>& parent,
                              const std::vector<int>& count) {
  const int runs = static_cast<int>(first.size()) - 1;
  std::vector<int> width(at(runs));
  std::vector<double> zeros(at(runs), 0.0);
  std::vector<bool> joined(at(runs), false);  // with the run before it
  for (int s = 0; s < runs; ++s) {
    width[at(s)] = first[at(s) + 1] - first[at(s)];
  }
  for (int s = runs - 2; s >= 0; --s) {
    const int next = first[at(s) + 1];
    if (parent[at(next - 1)] != next) {
      continue;  // what follows is not the parent
    }
    const int below = count[at(next)];  // rows of the parent's first column
    const double a = width[at(s)];
    const double b = width[at(s) + 1];
    const double fill = a * (a + below - count[at(first[at(s)])]);
    const double all = zeros[at(s) + 1] + zeros[at(s)] + fill;
    const double share = all / (0.5 * (a + b) * (a + b + 1.0) + (a + b) * (below - b));
    const double columns = a + b;
    if (columns <= kAlwaysJoined || fill == 0.0 || (columns <= kNarrow && share < kNarrowZeros) ||
        (columns <= kMedium && share < kMediumZeros) || share < kWideZeros) {
      joined[at(s) + 1] = true;
      width[at(s)] += width[at(s) + 1];
      zeros[at(s)] = all;
    }
  }
  std::vector<int> result;
  for (int s = 0; s < runs; ++s) {
    if (!joined[at(s)]) {
      result.push_back(first[at(s)]);
    }
  }
  result.push_back(first.back());
  return result;
}

/// Fills in rows, tree and places from the runs of columns.
class Structure {
 public:
  Structure(const UpperPattern& upper, Supernodes& nodes) : nodes_(nodes) {
    const std::size_t n = nodes.unknown_of_column.size();
    supernode_of_.resize(n);
    for (int s = 0; s + 1 < static_cast<int>(nodes.first_column.size()); ++s) {
      std::fill(supernode_of_.begin() + nodes.first_column[at(s)],
                supernode_of_.begin() + nodes.first_column[at(s) + 1], s);
    }
    find_rows(upper);
    find_places();
  }

  [[nodiscard]] const std::vector<int>& supernode_of() const { return supernode_of_; }

 private:
  void find_rows(const UpperPattern& upper) {
    const std::size_t runs = nodes_.first_column.size() - 1;
    std::vector<std::vector<int>> below(runs);  // rows each supernode meets in the matrix
    for (int column = 0; column < static_cast<int>(supernode_of_.size()); ++column) {
      for (std::size_t e = upper.offsets[at(column)]; e < upper.offsets[at(column) + 1]; ++e) {
        auto& list = below[at(supernode_of_[at(upper.rows[e])])];
        if (list.empty() || list.back() != column) {
          list.push_back(column);
        }
      }
    }
    nodes_.parent.assign(runs, -1);
    std::vector<int> seen(supernode_of_.size(), -1);
    std::vector<std::vector<int>> children(runs);
    for (int s = 0; s < static_cast<int>(runs); ++s) {
      const std::size_t start = nodes_.rows.size();
      const int end = nodes_.first_column[at(s) + 1];
      for (int c = nodes_.first_column[at(s)]; c < end; ++c) {
        nodes_.rows.push_back(c);
      }
      const std::size_t own = nodes_.rows.size();
      const auto add = [&](int row) {
        if (row >= end && seen[at(row)] != s) {
          seen[at(row)] = s;
          nodes_.rows.push_back(row);
        }
      };
      for (const int row : below[at(s)]) {
        add(row);
      }
      for (const int child : children[at(s)]) {
        for (std::size_t r = nodes_.row_start[at(child)]; r < nodes_.row_start[at(child) + 1];
             ++r) {
          add(nodes_.rows[r]);
        }
      }
      std::sort(nodes_.rows.begin() + static_cast<std::ptrdiff_t>(own), nodes_.rows.end());
      if (nodes_.rows.size() > own) {
        nodes_.parent[at(s)] = supernode_of_[at(nodes_.rows[own])];
        children[at(nodes_.parent[at(s)])].push_back(s);
      }
      nodes_.row_start.push_back(nodes_.rows.size());
      nodes_.value_start.push_back(nodes_.value_start.back() +
                                   (nodes_.rows.size() - start) * (own - start));
      nodes_.first_descendant.push_back(
          children[at(s)].empty() ? s : nodes_.first_descendant[at(children[at(s)].front())]);
    }
  }

  void find_places() {
    nodes_.place_in_parent.assign(nodes_.rows.size(), -1);
    for (int s = 0; s < nodes_.count(); ++s) {
      const int parent = nodes_.parent[at(s)];
      if (parent < 0) {
        continue;
      }
      std::size_t p = nodes_.row_start[at(parent)];
      for (std::size_t r = nodes_.row_start[at(s)] + at(nodes_.columns(s));
           r < nodes_.row_start[at(s) + 1]; ++r) {
        while (nodes_.rows[p] < nodes_.rows[r]) {
          ++p;
        }
        nodes_.place_in_parent[r] = static_cast<int>(p - nodes_.row_start[at(parent)]);
      }
    }
  }

  Supernodes& nodes_;
  std::vector<int> supernode_of_{};
};

/// Where the entries of the matrix go, supernode by supernode so that rows are found by a table.
void find_entries(const Eigen::SparseMatrix<double>& A, const std::vector<int>& column_of,
                  const std::vector<int>& supernode_of, Supernodes& nodes) {
  struct LowerEntry {
    int row;
    int column;
    std::size_t number;
  };

  std::vector<std::size_t> start(nodes.parent.size() + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
        if (it.row() >= j) {
          const int a = column_of[static_cast<std::size_t>(it.row())];
          const int b = column_of[static_cast<std::size_t>(j)];
          visit(std::max(a, b), std::min(a, b));
        }
      }
    }
  };
  for_each([&](int, int column) { ++start[at(supernode_of[at(column)]) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<LowerEntry> entries(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  std::size_t number = 0;
  for_each([&](int row, int column) {
    entries[next[at(supernode_of[at(column)])]++] = {row, column, number++};
  });
  nodes.value_of_entry.resize(entries.size());
  std::vector<int> place(supernode_of.size(), 0);
  for (int s = 0; s < nodes.count(); ++s) {
    for (std::size_t r = nodes.row_start[at(s)]; r < nodes.row_start[at(s) + 1]; ++r) {
      place[at(nodes.rows[r])] = static_cast<int>(r - nodes.row_start[at(s)]);
    }
    for (std::size_t e = start[at(s)]; e < start[at(s) + 1]; ++e) {
      const LowerEntry& entry = entries[e];
      nodes.value_of_entry[entry.number] =
          nodes.value_start[at(s)] + at(place[at(entry.row)]) +
          at(entry.column - nodes.first_column[at(s)]) * at(nodes.height(s));
    }
  }
}

}  // namespace

Supernodes find_supernodes(const Eigen::SparseMatrix<double>& A, const std::vector<int>& order) {
  Supernodes nodes;
  std::vector<int> column_of(order.size());
  const auto number = [&column_of](const std::vector<int>& unknowns) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      column_of[at(unknowns[k])] = static_cast<int>(k);
    }
  };
  number(order);
  const std::vector<int> tree = elimination_tree(upper_pattern(A, column_of));
  for (const int k : post_order(tree)) {
    nodes.unknown_of_column.push_back(order[at(k)]);
  }
  number(nodes.unknown_of_column);
  const UpperPattern upper = upper_pattern(A, column_of);
  const std::vector<int> parent = elimination_tree(upper);
  const std::vector<int> count = column_counts(upper, parent);
  nodes.first_column = relaxed_runs(fundamental_runs(parent, count), parent, count);
  const Structure structure(upper, nodes);
  find_entries(A, column_of, structure.supernode_of(), nodes);
  return nodes;
}

}  // namespace vantage
