// SPDX-License-Identifier: MIT
#include "visible_table.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace vantage::cli {

std::string visible_table(const VisibleSets& sets, std::span<const double> significance) {
  const std::size_t row = (sets.view_count() + 7) / 8;
  const std::size_t record = 8 + row;
  std::string header = "{'descr': [('significance', '<f8'), ('seen', '|u1', (" +
                       std::to_string(row) + ",))], 'fortran_order': False, 'shape': (" +
                       std::to_string(significance.size()) + ",), }";
  constexpr std::size_t kPreamble = 10;
  constexpr std::size_t kAlignment = 64;
  header.resize((kPreamble + header.size() + kAlignment) / kAlignment * kAlignment - kPreamble - 1,
                ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + record * significance.size(), '\0');
  for (std::size_t v = 0; v < significance.size(); ++v) {
    const auto bits = std::bit_cast<std::uint64_t>(significance[v]);
    for (std::size_t k = 0; k < 8; ++k) {
      bytes[start + v * record + k] = static_cast<char>((bits >> (8 * k)) & 0xFFU);
    }
  }
  for (std::size_t i = 0; i < sets.view_count(); ++i) {
    const auto words = sets.row(i);
    for (std::size_t w = 0; w < words.size(); ++w) {
      for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
        const std::size_t v = 64 * w + static_cast<std::size_t>(std::countr_zero(left));
        char& byte = bytes[start + v * record + 8 + i / 8];
        byte = static_cast<char>(static_cast<unsigned char>(byte) | (1U << (i % 8)));
      }
    }
  }
  return bytes;
}

}  // namespace vantage::cli
