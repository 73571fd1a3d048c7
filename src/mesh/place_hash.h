// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "vantage/core/vec3.h"

namespace vantage {

/// The same number for vertices in the same place, to the bit but for −0. Sums of it do not hang on the order of the
/// vertices. The finaliser is that of SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom
/// Number Generators", 2014.
inline std::uint64_t place_hash(const Vec3& place) {
  std::uint64_t hash = 0;
  for (const double c : {place.x(), place.y(), place.z()}) {
    hash += std::bit_cast<std::uint64_t>(c + 0.0);  // −0 is 0
    hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
    hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
    hash ^= hash >> 31U;
  }
  return hash;
}

}  // namespace vantage
