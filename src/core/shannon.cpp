// SPDX-License-Identifier: MIT
#include "core/shannon.h"

namespace vantage {

const std::array<LogCell, kLogCells> kLogTable = [] {
  std::array<LogCell, kLogCells> table{};
  for (std::size_t i = 0; i < kLogCells; ++i) {
    const double middle = 1.0 + (static_cast<double>(i) + 0.5) / static_cast<double>(kLogCells);
    // Both cells at 1 have 1 itself, so that numbers near it lose nothing.
    const double inverse = i == 0 ? 1.0 : i + 1 == kLogCells ? 0.5 : 1.0 / middle;
    table[i] = {inverse, -std::log2(inverse)};
  }
  return table;
}();

}  // namespace vantage
