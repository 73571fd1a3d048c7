// SPDX-License-Identifier: MIT
#include "contraction/step_limits.h"

#include <cmath>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

/// A box side may grow by this factor plus a hundredth of D before a step counts as diverged.
constexpr double kBoxGrowth = 1.2;
constexpr double kBoxSlack = 0.01;
constexpr double kSafeCotangent = 115.0;
constexpr double kFirstShift = 1e-14;  // relative to the largest diagonal entry; × 100 a level

}  // namespace

LaplacianLimits limits_of(const ContractionOptions& options, int regularisation) {
  LaplacianLimits limits{.diagonal = options.diagonal_limit};
  if (regularisation > kAsDefined) {
    limits.cotangent = kSafeCotangent;
    limits.non_negative = true;
  }
  return limits;
}

StepBound bound_of(int regularisation) {
  return regularisation == kAsDefined ? StepBound::BoxAndSphere : StepBound::Box;
}

double shift_of(double largest, int regularisation) {
  return regularisation > kAsDefined + 1
             ? largest * kFirstShift * std::pow(100.0, regularisation - kAsDefined - 2)
             : 0.0;
}

Vec3 largest_box(const std::vector<Vec3>& start, double diameter) {
  return kBoxGrowth * bounding_box(start).size() + Vec3::Constant(kBoxSlack * diameter);
}

}  // namespace vantage
