// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace vantage {

/// Spearman's rank correlation, equal values sharing their mean rank; NaN if either does not vary.
/// \pre both have the same size
double spearman(std::span<const double> a, std::span<const double> b);

}  // namespace vantage
