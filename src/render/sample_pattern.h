// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace vantage {

/// Places of the samples of a pixel, relative to its centre, px: a square grid turned so that no two
/// share a row or column, spread by a tent filter. The same for every pixel.
/// \param samples rounded up to a square.
std::vector<std::array<double, 2>> sample_pattern(int samples);

}  // namespace vantage
