// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

/// \file
/// Largest and least of what a test computes. std::max() and std::min() pass over what is no
/// number: a worst error found with them is small where every error is NaN. These keep it, so that
/// no comparison with a limit holds.

namespace vantage::test {

/// The larger of two numbers; NaN where either is.
template <std::floating_point Number>
Number larger(Number a, Number b) {
  return std::isnan(a) || a >= b ? a : b;
}

/// The smaller of two numbers; NaN where either is.
template <std::floating_point Number>
Number smaller(Number a, Number b) {
  return std::isnan(a) || a <= b ? a : b;
}

}  // namespace vantage::test
