// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

/// \file
/// Loops over the vector types of gcc and clang are compiled twice: for processors with 256-bit
/// registers ([[gnu::target("avx2")]]) and for all others. Neither version may contract products and
/// sums (the project is compiled without): both then give the same bits.

/// For what both versions are made of: it takes the instructions of the function it ends up in.
#define VANTAGE_INLINE [[gnu::always_inline]] inline

namespace vantage {

/// What holds four or eight numbers side by side. gcc 12 forgets the size of a vector that depends on a
/// template's parameter, so each is written out.
template <unsigned Lanes>
struct Registers;

template <>
struct Registers<4> {
  using Floats = float __attribute__((vector_size(4 * 4)));
  using Keys = std::uint32_t __attribute__((vector_size(4 * 4)));
  using Truths = std::int32_t __attribute__((vector_size(4 * 4)));
};

template <>
struct Registers<8> {
  using Floats = float __attribute__((vector_size(4 * 8)));
  using Keys = std::uint32_t __attribute__((vector_size(4 * 8)));
  using Truths = std::int32_t __attribute__((vector_size(4 * 8)));
};

/// Bit i is set where truth i is. \pre each is 0 or has all bits set, as comparisons give them.
VANTAGE_INLINE unsigned bits_of(const Registers<4>::Truths& truths) {
#if defined(__x86_64__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<const __m128&>(truths)));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 4; ++i) {
    bits |= truths[i] != 0 ? 1U << i : 0U;
  }
  return bits;
#endif
}

VANTAGE_INLINE unsigned bits_of(const Registers<8>::Truths& truths) {
  const Registers<4>::Truths low = __builtin_shufflevector(truths, truths, 0, 1, 2, 3);
  const Registers<4>::Truths high = __builtin_shufflevector(truths, truths, 4, 5, 6, 7);
  return bits_of(low) | bits_of(high) << 4U;
}

#if defined(__x86_64__)
inline bool has_wide_registers() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}
#endif

}  // namespace vantage
