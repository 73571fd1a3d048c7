// SPDX-License-Identifier: MIT
#include "orientation/evidence.h"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

// Of the box's longest side: what thin and flat things differ in by less is nothing.
constexpr double kThin = 0.01;
constexpr double kNextToNothing = 1e-3;

}  // namespace

double value_of(std::string_view name, const Evidence& evidence) {
  return std::find_if(evidence.begin(), evidence.end(),
                      [&](const OrientationFeature& feature) { return feature.name == name; })
      ->value;
}

double share_of(double part, double whole) {
  return whole > kNextToNothing ? part / whole : 0.0;
}

double log_ratio(double a, double b) {
  return std::log2((a + kThin) / (b + kThin));
}

}  // namespace vantage
