// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// \file
/// The dense arithmetic of the sparse Cholesky, on column-major blocks: entry (i, j) of a block with
/// stride s stands at i + s j. Each entry's sum runs over the same terms in the same order on every
/// processor, with wide registers or without, so that the bits are the same everywhere.

namespace vantage {

/// C −= A Bᵀ for C of `rows` × `columns`, A of rows × depth, B of columns × depth.
struct ProductShape {
  std::size_t rows;
  std::size_t columns;
  std::size_t depth;
};

/// One block in memory.
struct ConstBlock {
  const double* first;
  std::size_t stride;
};

/// \param lower only entries (i, j) with i >= j are wanted; a few others are overwritten too.
void subtract_product(double* C, std::size_t stride, ConstBlock A, ConstBlock B, ProductShape shape,
                      bool lower);

/// Cholesky factorisation of the first `columns` rows of a panel, and the rows below divided by it.
/// The entries above the diagonal are not read but may be overwritten.
/// \return false if a pivot is not positive.
bool factorize_panel(double* panel, std::size_t height, std::size_t columns);

/// Right-hand sides that are solved for together; fewer are padded.
inline constexpr std::size_t kRightSides = 4;

/// Solves with the first `columns` rows of a factorised panel and subtracts what follows from the
/// rows below.
/// \param rows height × kRightSides, row by row.
void solve_forward(const double* panel, std::size_t height, std::size_t columns, double* rows);

/// Solves for the first `columns` rows from those below, with the panel transposed.
/// \param rows as above.
void solve_backward(const double* panel, std::size_t height, std::size_t columns, double* rows);

}  // namespace vantage
