// SPDX-License-Identifier: MIT
#pragma once

#include <span>

/// \file
/// Angles of many pairs of vectors at a time.

namespace vantage {

/// The angle of each vector (cosine, sine) from the x axis, in [−π, π], wrong by less than 1e-15;
/// 0 for the zero vector. The same bits with every C library.
/// \pre as many of each, all finite.
void angles_of(std::span<const double> sine, std::span<const double> cosine,
               std::span<double> angle);

}  // namespace vantage
