// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

/// \file
/// Random numbers that are the same on every platform: PCG32 (O'Neill, "PCG: A Family of Simple
/// Fast Space-Efficient Statistically Good Algorithms for Random Number Generation", 2014).

namespace vantage {

/// A small seeded generator; one stream per item keeps parallel work independent of its order.
class Pcg32 {
 public:
  /// \param seed start of the sequence. \param stream selects one of 2^63 independent sequences.
  explicit Pcg32(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint32_t next();                      ///< Uniform in [0, 2^32).
  std::uint32_t below(std::uint32_t bound);  ///< Uniform in [0, bound), without bias; bound > 0.
  double uniform();                          ///< Uniform in [0, 1).

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_ = 1;
};

}  // namespace vantage
