// SPDX-License-Identifier: MIT
#include "core/shannon.h"

namespace vantage {
namespace {

/// Logarithm to base 2 of a number in [1/2, 1]: ln x = 2 artanh z with z = (x - 1) / (x + 1). Of
/// additions, products and quotients alone, which round alike everywhere, as std::log2 need not.
constexpr double log_2_by_series(double x) {
  constexpr double kPerNat = 1.4426950408889634;
  const double z = (x - 1.0) / (x + 1.0);
  double sum =
      0.0;  // of z^(2k) / (2k + 1), the smallest first; |z| <= 1/3, so that 1/3^40 is left out
  for (int k = 19; k >= 0; --k) {
    sum = sum * z * z + 1.0 / (2.0 * k + 1.0);
  }
  return 2.0 * kPerNat * z * sum;
}

}  // namespace

constinit const std::array<LogCell, kLogCells> kLogTable = [] {
  std::array<LogCell, kLogCells> table{};
  for (std::size_t i = 0; i < kLogCells; ++i) {
    const double middle = 1.0 + (static_cast<double>(i) + 0.5) / static_cast<double>(kLogCells);
    // Both cells at 1 have 1 itself, so that numbers near it lose nothing.
    const double inverse = i == 0 ? 1.0 : i + 1 == kLogCells ? 0.5 : 1.0 / middle;
    table[i] = {inverse, -log_2_by_series(inverse)};
  }
  return table;
}();

}  // namespace vantage
