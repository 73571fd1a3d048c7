// SPDX-License-Identifier: MIT
#include "operators/dense_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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
/// Columns of a panel that are solved for before the rows below are looked at.
constexpr std::size_t kSolved = 4;
static_assert(kRightSides == kLanes && kSolved == 4);

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using Truths = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

VANTAGE_INLINE void load(const double* from, Lanes& to) {
  std::memcpy(&to, from, sizeof(Lanes));
}

VANTAGE_INLINE void store(const Lanes& value, double* to) {
  std::memcpy(to, &value, sizeof(Lanes));
}

VANTAGE_INLINE void subtract_at(double* to, const Lanes& sum) {
  Lanes value;
  std::memcpy(&value, to, sizeof(Lanes));
  value -= sum;
  std::memcpy(to, &value, sizeof(Lanes));
}

/// Calls call<count>(): the compiler unrolls counts that it knows. \param count 1 to 4.
template <class Call>
VANTAGE_INLINE void with_columns(std::size_t count, const Call& call) {
  static_assert(kSolved == 4 && kTileColumns == 4);
  switch (count) {
    case 1:
      return call.template operator()<1>();
    case 2:
      return call.template operator()<2>();
    case 3:
      return call.template operator()<3>();
    default:
      return call.template operator()<4>();
  }
}

/// `Wide` times kLanes rows of `Columns` columns, of which the first `done` rows stay as they are.
template <std::size_t Wide, std::size_t Columns>
VANTAGE_INLINE void tile(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                         std::size_t depth, std::size_t done) {
  Lanes sum[Columns][Wide] = {};
  for (std::size_t k = 0; k < depth; ++k) {
    Lanes low;
    Lanes high{};
    load(A.first + k * A.stride, low);
    if constexpr (Wide == 2) {
      load(A.first + k * A.stride + kLanes, high);
    }
    for (std::size_t j = 0; j < Columns; ++j) {
      const double b = B.first[j + k * B.stride];
      sum[j][0] += low * b;
      if constexpr (Wide == 2) {
        sum[j][1] += high * b;
      }
    }
  }
  if (done == 0) {
    for (std::size_t j = 0; j < Columns; ++j) {
      for (std::size_t w = 0; w < Wide; ++w) {
        subtract_at(C + j * stride + w * kLanes, sum[j][w]);
      }
    }
    return;
  }
  for (std::size_t w = 0; w < Wide; ++w) {
    const Truths wanted = Truths{0, 1, 2, 3} + static_cast<std::int64_t>(w * kLanes) >=
                          static_cast<std::int64_t>(done);
    for (std::size_t j = 0; j < Columns; ++j) {
      subtract_at(C + j * stride + w * kLanes, wanted ? sum[j][w] : Lanes{});
    }
  }
}

/// Fewer rows than a register holds.
VANTAGE_INLINE void border(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                           ProductShape shape) {
  for (std::size_t j = 0; j < shape.columns; ++j) {
    double sum[kLanes] = {};
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

/// `Columns` columns from row `first` on. The last rows are done by a tile that begins in those above: it
/// takes a third of the time of plain loops, and most fronts are small.
template <std::size_t Columns>
VANTAGE_INLINE void subtract_columns(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                                     ProductShape shape, std::size_t first) {
  const auto rows_from = [&A](std::size_t i) { return ConstBlock{A.first + i, A.stride}; };
  for (std::size_t i = first; i < shape.rows;) {
    const std::size_t left = shape.rows - i;
    if (left > kLanes && shape.rows >= kTileRows) {
      const std::size_t done = kTileRows - std::min(left, kTileRows);
      tile<2, Columns>(C + (i - done), stride, rows_from(i - done), B, shape.depth, done);
      i += kTileRows;
    } else if (shape.rows >= kLanes) {
      const std::size_t done = kLanes - std::min(left, kLanes);
      tile<1, Columns>(C + (i - done), stride, rows_from(i - done), B, shape.depth, done);
      i += kLanes;
    } else {
      border(C + i, stride, rows_from(i), B, {left, Columns, shape.depth});
      break;
    }
  }
}

VANTAGE_INLINE void subtract_slice(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                                   ProductShape shape, bool lower) {
  for (std::size_t j = 0; j < shape.columns; j += kTileColumns) {
    with_columns(
        std::min(kTileColumns, shape.columns - j), [&]<std::size_t Columns>() __attribute__((
                                                       always_inline)) {
          subtract_columns<Columns>(C + j * stride, stride, A, {B.first + j, B.stride}, shape,
                                    lower ? j : 0);
        });
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

/// `Columns` columns of a panel, of which `from` is the first, into the rows from `end` on.
template <std::size_t Columns>
VANTAGE_INLINE void forward_below(const double* from, std::size_t height, std::size_t end,
                                  const Lanes* x, double* rows) {
  for (std::size_t i = end; i < height; ++i) {
    Lanes value;
    load(rows + i * kRightSides, value);
    for (std::size_t l = 0; l < Columns; ++l) {
      value -= from[i + l * height] * x[l];
    }
    store(value, rows + i * kRightSides);
  }
}

VANTAGE_INLINE void forward_all(const double* panel, std::size_t height, std::size_t columns,
                                double* rows) {
  for (std::size_t b = 0; b < columns; b += kSolved) {
    const std::size_t end = std::min(columns, b + kSolved);
    Lanes x[kSolved];
    for (std::size_t j = b; j < end; ++j) {
      load(rows + j * kRightSides, x[j - b]);
      for (std::size_t l = b; l < j; ++l) {
        x[j - b] -= panel[j + l * height] * x[l - b];
      }
      x[j - b] /= panel[j + j * height];
      store(x[j - b], rows + j * kRightSides);
    }
    const double* from = panel + b * height;
    with_columns(
        end - b, [&]<std::size_t Columns>() __attribute__((always_inline)) {
          forward_below<Columns>(from, height, end, x, rows);
        });
  }
}

/// The rows from `end` on times `Columns` columns of a panel, of which `from` is the first.
template <std::size_t Columns>
VANTAGE_INLINE void sums_below(const double* from, std::size_t height, std::size_t end,
                               const double* rows, Lanes* sum) {
  for (std::size_t i = end; i < height; ++i) {
    Lanes value;
    load(rows + i * kRightSides, value);
    for (std::size_t l = 0; l < Columns; ++l) {
      sum[l] += from[i + l * height] * value;
    }
  }
}

VANTAGE_INLINE void backward_all(const double* panel, std::size_t height, std::size_t columns,
                                 double* rows) {
  for (std::size_t done = 0; done < columns;) {
    const std::size_t end = columns - done;
    const std::size_t b = (end - 1) / kSolved * kSolved;
    Lanes sum[kSolved] = {};
    const double* from = panel + b * height;
    with_columns(
        end - b, [&]<std::size_t Columns>() __attribute__((always_inline)) {
          sums_below<Columns>(from, height, end, rows, sum);
        });
    Lanes x[kSolved];
    for (std::size_t j = end; j-- > b;) {
      load(rows + j * kRightSides, x[j - b]);
      x[j - b] -= sum[j - b];
      for (std::size_t l = j + 1; l < end; ++l) {
        x[j - b] -= panel[l + j * height] * x[l - b];
      }
      x[j - b] /= panel[j + j * height];
      store(x[j - b], rows + j * kRightSides);
    }
    done = columns - b;
  }
}

void subtract_anywhere(double* C, std::size_t stride, ConstBlock A, ConstBlock B,
                       ProductShape shape, bool lower) {
  subtract_all(C, stride, A, B, shape, lower);
}

bool factorize_anywhere(double* panel, std::size_t height, std::size_t columns) {
  return factorize_all(panel, height, columns);
}

void forward_anywhere(const double* panel, std::size_t height, std::size_t columns, double* rows) {
  forward_all(panel, height, columns, rows);
}

void backward_anywhere(const double* panel, std::size_t height, std::size_t columns, double* rows) {
  backward_all(panel, height, columns, rows);
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

[[gnu::target("avx2")]] void forward_wide(const double* panel, std::size_t height,
                                          std::size_t columns, double* rows) {
  forward_all(panel, height, columns, rows);
}

[[gnu::target("avx2")]] void backward_wide(const double* panel, std::size_t height,
                                           std::size_t columns, double* rows) {
  backward_all(panel, height, columns, rows);
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

void solve_forward(const double* panel, std::size_t height, std::size_t columns, double* rows) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    forward_wide(panel, height, columns, rows);
    return;
  }
#endif
  forward_anywhere(panel, height, columns, rows);
}

void solve_backward(const double* panel, std::size_t height, std::size_t columns, double* rows) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    backward_wide(panel, height, columns, rows);
    return;
  }
#endif
  backward_anywhere(panel, height, columns, rows);
}

}  // namespace vantage
