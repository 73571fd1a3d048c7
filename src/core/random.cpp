// SPDX-License-Identifier: MIT
#include "core/random.h"

#include <bit>

namespace vantage {
namespace {
// Constants of the PCG family (O'Neill 2014, section 6.2).
constexpr std::uint64_t kMultiplier = 6364136223846793005ULL;
}  // namespace

Pcg32::Pcg32(std::uint64_t seed, std::uint64_t stream) : increment_((stream << 1U) | 1U) {
  next();
  state_ += seed;
  next();
}

std::uint32_t Pcg32::next() {
  const std::uint64_t old = state_;
  state_ = old * kMultiplier + increment_;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  return std::rotr(shifted, static_cast<int>(old >> 59U));
}

std::uint32_t Pcg32::below(std::uint32_t bound) {
  // Values below 2^32 mod bound are thrown away, so that each remainder is equally likely.
  const std::uint32_t threshold = (0U - bound) % bound;
  for (;;) {
    const std::uint32_t value = next();
    if (value >= threshold) {
      return value % bound;
    }
  }
}

double Pcg32::uniform() {
  return static_cast<double>(next()) * 0x1p-32;
}

}  // namespace vantage
