// SPDX-License-Identifier: MIT
#pragma once

/// \file
/// Loops over the vector types of gcc and clang are compiled twice: for processors with 256-bit
/// registers ([[gnu::target("avx2")]]) and for all others. Neither version may contract products and
/// sums (the project is compiled without): both then give the same bits.

/// For what both versions are made of: it takes the instructions of the function it ends up in.
#define VANTAGE_INLINE [[gnu::always_inline]] inline

namespace vantage {

#if defined(__x86_64__)
inline bool has_wide_registers() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}
#endif

}  // namespace vantage
