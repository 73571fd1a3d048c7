// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "vantage/mesh/tri_mesh.h"

#include "core/wide_registers.h"

// Functions that take or give wide registers are inlined, all of them: nobody else calls them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage {

template <class Numbers, class Number>
VANTAGE_INLINE Numbers load(const Number* from) {
  Numbers numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

template <class Numbers, class Number, std::size_t Lanes>
VANTAGE_INLINE void keep(const Numbers& numbers, std::array<Number, Lanes>& to) {
  static_assert(sizeof numbers == sizeof to);
  std::memcpy(to.data(), &numbers, sizeof to);
}

/// Some faces ready to tell which points may lie behind them, one lane each. Along a side x, y, 1
/// are worth what is positive inside, its length times the distance.
template <unsigned Lanes>
struct FacePacket {
  using Floats = std::array<float, Lanes>;
  using Numbers = std::array<std::uint32_t, Lanes>;

  struct Side {
    Floats along_x, along_y, offset;
  };

  unsigned count = 0;
  Numbers face;
  Numbers left, right, top, bottom;  // the cells it touches
  Floats nearest;                    // its least depth, rounded down
  std::array<Side, 3> sides;
  Floats error_bound;  // error of these values
  Floats least;        // points with less than this are outside
};

/// The samples of an EyeGrid in the order of their cells, a column each.
struct SampleColumns {
  const float* x;
  const float* y;
  const float* depth;
  const std::uint32_t* sample;
};

/// One face of a packet, spread over registers.
template <unsigned Lanes>
class FaceTest {
 public:
  VANTAGE_INLINE FaceTest(const FacePacket<Lanes>& of, unsigned lane, const Triangle& corners) {
    const Floats zero{};
    const Samples none{};
    nearest_ = zero + of.nearest[lane];
    least_ = zero + of.least[lane];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& side = of.sides[k];
      sides_[k] = {zero + side.along_x[lane], zero + side.along_y[lane], zero + side.offset[lane]};
      corners_[k] = none + corners[k];
    }
  }

  /// Bit i is set if the sample in slot + i may lie behind the face and is none of its corners.
  [[nodiscard]] VANTAGE_INLINE unsigned may_hide(const SampleColumns& samples,
                                                 std::size_t slot) const {
    const auto x = load<Floats>(samples.x + slot);
    const auto y = load<Floats>(samples.y + slot);
    typename Registers<Lanes>::Truths out = load<Floats>(samples.depth + slot) < nearest_;
    for (const Side& side : sides_) {
      out |= x * side.along_x + y * side.along_y + side.offset < least_;
    }
    const auto sample = load<Samples>(samples.sample + slot);
    for (const Samples& corner : corners_) {
      out |= sample == corner;
    }
    return bits_of(out) ^ ((1U << Lanes) - 1U);
  }

 private:
  using Floats = typename Registers<Lanes>::Floats;
  using Samples = typename Registers<Lanes>::Keys;

  struct Side {
    Floats along_x, along_y, offset;
  };

  Floats nearest_, least_;
  std::array<Side, 3> sides_;
  std::array<Samples, 3> corners_;
};

}  // namespace vantage
