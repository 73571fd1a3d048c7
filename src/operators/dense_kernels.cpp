// SPDX-License-Identifier: MIT
#include "operators/dense_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/wide_registers.h"

namespace vantage {
namespace {

constexpr std::size_t kLanes = 4;
constexpr std::size_t kTileRows = 2 * kLanes;
constexpr std::size_t kTileColumns = 4;
/// Columns of A taken at a time: what of it is in use stays in the second cache.
constexpr std::size_t kDepth = 96;
/// Columns of a panel factorised by plain loops before the rest is updated by products.
constexpr std::size_t kPanel = 16;

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

VANTAGE_INLINE void load(const double* from, Lanes& to) {
  std::memcpy(&to, from, sizeof(Lanes));
}

VANTAGE_INLINE void subtract_at(double* to, const Lanes& sum) {
  Lanes value;
  std::memcpy(&value, to, sizeof(Lanes));
  value -= sum;
  std::memcpy(to, &value, sizeof(Lanes));
}

/// A full tile of kTileRows × kTileColumns.
VANTAGE_INLINE void tile(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                         std::size_t depth) {
  Lanes sum[kTileColumns][2] = {};
  for (std::size_t k = 0; k < depth; ++k) {
    Lanes low;
    Lanes high;
    load(A.first + k * A.stride, low);
    load(A.first + k * A.stride + kLanes, high);
    for (std::size_t j = 0; j < kTileColumns; ++j) {
      const double b = B.first[j + k * B.stride];
      sum[j][0] += low * b;
      sum[j][1] += high * b;
    }
  }
  for (std::size_t j = 0; j < kTileColumns; ++j) {
    subtract_at(C + j * stride, sum[j][0]);
    subtract_at(C + j * stride + kLanes, sum[j][1]);
  }
}

/// What is left at the borders.
VANTAGE_INLINE void border(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                           ProductShape shape) {
  for (std::size_t j = 0; j < shape.columns; ++j) {
    double sum[kTileRows] = {};
    for (std::size_t k = 0; k < shape.depth; ++k) {
      const double b = B.first[j + k * B.stride];
      for (std::size_t i = 0; i < shape.rows; ++i) {
        sum[i] += A.first[i + k * A.stride] * b;
      }
    }
    for (std::size_t i = 0; i < shape.rows; ++i) {
      C[i + j * stride] -= sum[i];
    }
  }
}

VANTAGE_INLINE void subtract_slice(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                                   ProductShape shape, bool lower) {
  for (std::size_t j = 0; j < shape.columns; j += kTileColumns) {
    const std::size_t columns = std::min(kTileColumns, shape.columns - j);
    for (std::size_t i = lower ? j : 0; i < shape.rows; i += kTileRows) {
      const std::size_t rows = std::min(kTileRows, shape.rows - i);
      double* to = C + i + j * stride;
      const ConstBlock a{A.first + i, A.stride};
      const ConstBlock b{B.first + j, B.stride};
      if (rows == kTileRows && columns == kTileColumns) {
        tile(to, stride, a, b, shape.depth);
      } else {
        border(to, stride, a, b, {rows, columns, shape.depth});
      }
    }
  }
}

VANTAGE_INLINE void subtract_all(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                                 ProductShape shape, bool lower) {
  for (std::size_t k = 0; k < shape.depth; k += kDepth) {
    const ProductShape slice{shape.rows, shape.columns, std::min(kDepth, shape.depth - k)};
    subtract_slice(C, stride, {A.first + k * A.stride, A.stride},
                   {B.first + k * B.stride, B.stride}, slice, lower);
  }
}

VANTAGE_INLINE bool factorize_all(double* panel, std::size_t height, std::size_t columns) {
  for (std::size_t b = 0; b < columns; b += kPanel) {
    const std::size_t end = std::min(columns, b + kPanel);
    for (std::size_t j = b; j < end; ++j) {
      double* column = panel + j * height;
      for (std::size_t l = b; l < j; ++l) {
        const double* before = panel + l * height;
        const double factor = before[j];
        for (std::size_t i = j; i < height; ++i) {
          column[i] -= factor * before[i];
        }
      }
      const double pivot = column[j];
      if (!(pivot > 0.0)) {
        return false;
      }
      column[j] = std::sqrt(pivot);
      const double scale = 1.0 / column[j];
      for (std::size_t i = j + 1; i < height; ++i) {
        column[i] *= scale;
      }
    }
    if (end < columns) {
      const double* rows = panel + b * height + end;
      subtract_all(panel + end * height + end, height, {rows, height}, {rows, height},
                   {height - end, columns - end, end - b}, true);
    }
  }
  return true;
}

void subtract_anywhere(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                       ProductShape shape, bool lower) {
  subtract_all(C, stride, A, B, shape, lower);
}

bool factorize_anywhere(double* panel, std::size_t height, std::size_t columns) {
  return factorize_all(panel, height, columns);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void subtract_wide(double* C, std::size_t stride, ConstBlock A,
                                           ConstBlock B, ProductShape shape, bool lower) {
  subtract_all(C, stride, A, B, shape, lower);
}

[[gnu::target("avx2")]] bool factorize_wide(double* panel, std::size_t height,
                                            std::size_t columns) {
  return factorize_all(panel, height, columns);
}
#endif

}  // namespace

void subtract_product(double* C, std::size_t stride, ConstBlock A, ConstBlock B, ProductShape shape,
                      bool lower) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    subtract_wide(C, stride, A, B, shape, lower);
    return;
  }
#endif
  subtract_anywhere(C, stride, A, B, shape, lower);
}

bool factorize_panel(double* panel, std::size_t height, std::size_t columns) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    return factorize_wide(panel, height, columns);
  }
#endif
  return factorize_anywhere(panel, height, columns);
}

}  // namespace vantage
