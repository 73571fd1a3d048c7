// SPDX-License-Identifier: MIT
#include "render/sample_pattern.h"

#include <cmath>

namespace vantage {
namespace {

/// Half-width of the tent filter, px. It blurs hardly more than a box as wide as the pixel, and
/// leaves edges without steps.
constexpr double kFilterPx = 0.75;

}  // namespace

std::vector<std::array<double, 2>> sample_pattern(int samples) {
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples))));
  const auto tent = [](double u) {
    return kFilterPx * (u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u));
  };
  std::vector<std::array<double, 2>> pattern;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double u = (i + (j + 0.5) / side) / side;
      const double v = (j + (side - i - 0.5) / side) / side;
      pattern.push_back({tent(u), tent(v)});
    }
  }
  return pattern;
}

}  // namespace vantage
