// SPDX-License-Identifier: MIT
#include "view/turning.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <numbers>

#include "core/wide_registers.h"

namespace vantage {
namespace {

constexpr std::size_t kLanes = 4;
constexpr double kPi = std::numbers::pi;
constexpr double kTanSixteenth = 0.19891236737965800;  // tan(π/16)
constexpr double kTanEighth = 0.41421356237309505;     // tan(π/8)
constexpr double kTanThree = 0.66817863791929890;      // tan(3π/16)

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

VANTAGE_INLINE void angles_of_lanes(const Lanes& sine, const Lanes& cosine, Lanes& angle) {
  const Lanes zero{};
  const Lanes one = zero + 1.0;
  const Lanes height = sine < zero ? -sine : sine;
  const Lanes width = cosine < zero ? -cosine : cosine;
  const auto is_high = height > width;
  const Lanes longer = is_high ? height : width;
  const Lanes t = (is_high ? width : height) / (longer > zero ? longer : one);
  // atan t = atan c + atan ((t − c) / (1 + t c)) with the nearest of three c, so that the rest is
  // at most tan(π/16).
  const auto is_first = t <= kTanSixteenth + zero;
  const auto is_second = t <= kTanThree + zero;
  const Lanes c = is_first ? zero : (is_second ? kTanEighth + zero : one);
  const Lanes base = is_first ? zero : (is_second ? kPi / 8 + zero : kPi / 4 + zero);
  const Lanes u = (t - c) / (one + t * c);
  const Lanes w = u * u;
  // Its series; the first term left out is below 1e-18.
  Lanes sum = w * (-1.0 / 23) + 1.0 / 21;
  sum = sum * w - 1.0 / 19;
  sum = sum * w + 1.0 / 17;
  sum = sum * w - 1.0 / 15;
  sum = sum * w + 1.0 / 13;
  sum = sum * w - 1.0 / 11;
  sum = sum * w + 1.0 / 9;
  sum = sum * w - 1.0 / 7;
  sum = sum * w + 1.0 / 5;
  sum = sum * w - 1.0 / 3;
  const Lanes acute = base + (u + u * (sum * w));
  const Lanes right = is_high ? kPi / 2 - acute : acute;
  const Lanes whole = cosine < zero ? kPi - right : right;
  angle = sine < zero ? -whole : whole;
}

VANTAGE_INLINE void angles_here(std::span<const double> sine, std::span<const double> cosine,
                                std::span<double> angle) {
  std::array<double, kLanes> rest_sine{};
  std::array<double, kLanes> rest_cosine{};
  for (std::size_t i = 0; i < angle.size(); i += kLanes) {
    const bool is_whole = i + kLanes <= angle.size();
    if (!is_whole) {
      std::memcpy(rest_sine.data(), sine.data() + i, (angle.size() - i) * sizeof(double));
      std::memcpy(rest_cosine.data(), cosine.data() + i, (angle.size() - i) * sizeof(double));
    }
    Lanes s;
    Lanes c;
    Lanes a;
    std::memcpy(&s, is_whole ? sine.data() + i : rest_sine.data(), sizeof s);
    std::memcpy(&c, is_whole ? cosine.data() + i : rest_cosine.data(), sizeof c);
    angles_of_lanes(s, c, a);
    std::memcpy(angle.data() + i, &a, is_whole ? sizeof a : (angle.size() - i) * sizeof(double));
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void angles_wide(std::span<const double> sine,
                                         std::span<const double> cosine, std::span<double> angle) {
  angles_here(sine, cosine, angle);
}
#endif

}  // namespace

void angles_of(std::span<const double> sine, std::span<const double> cosine,
               std::span<double> angle) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    angles_wide(sine, cosine, angle);
    return;
  }
#endif
  angles_here(sine, cosine, angle);
}

}  // namespace vantage
