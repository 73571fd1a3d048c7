// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace vantage {

/// x log2 x, 0 at 0.
inline double x_log_x(double x) {
  return x > 0.0 ? x * std::log2(x) : 0.0;
}

/// Entropy in bits of a histogram of any positive total; 0 for an empty one.
template <class Bins>
double histogram_entropy(const Bins& bins) {
  double total = 0.0;
  double logs = 0.0;
  for (const double bin : bins) {
    total += bin;
    logs += x_log_x(bin);
  }
  return total > 0.0 ? std::log2(total) - logs / total : 0.0;
}

}  // namespace vantage
