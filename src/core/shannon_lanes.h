// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/wide_registers.h"

/// \file
/// Logarithms of several numbers at a time, for the loops over all that views share.

namespace vantage {

inline constexpr std::size_t kLogLanes = 4;
using LogLanes = double __attribute__((vector_size(kLogLanes * sizeof(double))));

/// Logarithms to base 2 of numbers that are normal and above 0: exact for powers of 2, else wrong by
/// less than 4e-16 of the larger of 1 and their size. Without a table, which lanes would have to wait
/// for: ln m = 2 artanh z with z = (m − 1) / (m + 1) and m in [√½, √2), so that |z| < 0.1716.
VANTAGE_INLINE void log_2(const LogLanes& x, LogLanes& result) {
  using Bits = std::uint64_t __attribute__((vector_size(kLogLanes * sizeof(std::uint64_t))));
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  constexpr std::uint64_t kOne = std::uint64_t{1023} << 52;
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // the bits of √½
  // Or-ed to a whole number below 2^52 these are the bits of 2^52 + the number.
  constexpr std::uint64_t kWhole = 0x4330000000000000;
  constexpr double kWholeAndBias = 0x1p52 + 1023.0;
  const Bits moved = reinterpret_cast<Bits>(x) + (kOne - kRootHalf);
  const Bits whole = (moved >> 52) | kWhole;
  const Bits mantissa = (moved & kMantissa) + kRootHalf;
  const LogLanes exponent = reinterpret_cast<LogLanes>(whole) - kWholeAndBias;
  const auto m = reinterpret_cast<LogLanes>(mantissa);
  const LogLanes z = (m - 1.0) / (m + 1.0);
  const LogLanes w = z * z;
  // 2 / ln 2 / (2k + 1) for z^(2k + 1); the first left out, of z^21, is below 2e-17.
  constexpr double kTwoPerNat = 2.8853900817779268;
  LogLanes sum = w * (kTwoPerNat / 19) + kTwoPerNat / 17;
  sum = sum * w + kTwoPerNat / 15;
  sum = sum * w + kTwoPerNat / 13;
  sum = sum * w + kTwoPerNat / 11;
  sum = sum * w + kTwoPerNat / 9;
  sum = sum * w + kTwoPerNat / 7;
  sum = sum * w + kTwoPerNat / 5;
  sum = sum * w + kTwoPerNat / 3;
  result = exponent + z * (sum * w + kTwoPerNat);
}

}  // namespace vantage
