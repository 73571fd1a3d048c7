// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// \file
/// Logarithms and entropies. Measures take some hundred million logarithms a model, so that a call for
/// each of them would cost more than what it is taken of.

namespace vantage {

/// Of the numbers in [1, 2) with the same leading seven bits: the inverse of one of them, and the
/// logarithm of that one to base 2.
struct LogCell {
  double inverse = 1.0;
  double log = 0.0;
};

inline constexpr std::size_t kLogBits = 7;
inline constexpr std::size_t kLogCells = std::size_t{1} << kLogBits;
extern const std::array<LogCell, kLogCells> kLogTable;

/// Logarithm to base 2, exact for powers of 2, else wrong by less than 4e-16 of the larger of 1 and
/// its size; the same bits with every C library. \pre x is normal: at least 2.3e-308 and finite.
inline double log_2(double x) {
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  constexpr std::uint64_t kOne = std::uint64_t{1023} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023);
  const LogCell& cell = kLogTable[(bits >> (52 - kLogBits)) % kLogCells];
  const double r = std::bit_cast<double>((bits & kMantissa) | kOne) * cell.inverse - 1.0;
  // ln (1 + r) for |r| <= 1/128, over ln 2; the first term left out is r^8 / 8.
  constexpr double kPerNat = 1.4426950408889634;
  const double series =
      r *
      (1.0 + r * (-1.0 / 2 +
                  r * (1.0 / 3 + r * (-1.0 / 4 + r * (1.0 / 5 + r * (-1.0 / 6 + r * (1.0 / 7)))))));
  return (exponent + cell.log) + kPerNat * series;
}

/// x log2 x, 0 at 0.
inline double x_log_x(double x) {
  return x > 0.0 ? x * log_2(x) : 0.0;
}

/// Entropy in bits of a histogram of any positive total; 0 for an empty one.
template <class Bins>
double histogram_entropy(const Bins& bins) {
  double total = 0.0;
  double logs = 0.0;
  for (const double bin : bins) {
    total += bin;
    logs += x_log_x(bin);
  }
  return total > 0.0 ? log_2(total) - logs / total : 0.0;
}

}  // namespace vantage
