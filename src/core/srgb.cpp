// SPDX-License-Identifier: MIT
#include "core/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vantage {
namespace {

std::array<double, 256> decode_table() {
  std::array<double, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) {
    table[byte] = linear_of_encoded(static_cast<double>(byte) / 255.0);
  }
  return table;
}

/// Rounded bytes without a power: the linear value from which on each is the nearest, and where to
/// begin to look.
struct EncodeTable {
  static constexpr std::size_t kCells = 4096;

  std::array<double, 257> from{};  // the last is never reached
  std::array<std::uint8_t, kCells + 1> first{};

  EncodeTable() {
    from[0] = -1.0;
    for (std::size_t byte = 1; byte <= 255; ++byte) {
      from[byte] = linear_of_encoded((static_cast<double>(byte) - 0.5) / 255.0);
    }
    from[256] = 2.0;
    std::size_t byte = 0;
    for (std::size_t cell = 0; cell <= kCells; ++cell) {
      while (from[byte + 1] <= static_cast<double>(cell) / kCells) {
        ++byte;
      }
      first[cell] = static_cast<std::uint8_t>(byte);
    }
  }

  /// \pre value is in [0, 1].
  [[nodiscard]] std::uint8_t byte(double value) const {
    std::size_t byte = first[static_cast<std::size_t>(value * kCells)];
    while (from[byte + 1] <= value) {
      ++byte;
    }
    return static_cast<std::uint8_t>(byte);
  }
};

}  // namespace

double linear_of_encoded(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double encoded_of_linear(double value) {
  const double clamped = value > 0.0 ? std::min(value, 1.0) : 0.0;
  return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

double linear_of_srgb(std::uint8_t byte) {
  static const std::array<double, 256> table = decode_table();
  return table[byte];
}

Vec3 linear_of_srgb(const Rgb8& colour) {
  return {linear_of_srgb(colour[0]), linear_of_srgb(colour[1]), linear_of_srgb(colour[2])};
}

std::uint8_t srgb_of_linear(double value) {
  static const EncodeTable table;
  const double clamped = value > 0.0 ? std::min(value, 1.0) : 0.0;
  return table.byte(clamped);
}

Rgb8 srgb_of_linear(const Vec3& colour) {
  return {srgb_of_linear(colour[0]), srgb_of_linear(colour[1]), srgb_of_linear(colour[2])};
}

}  // namespace vantage
