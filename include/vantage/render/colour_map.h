// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vantage/core/image.h"

/// \file
/// Colours of numbers. docs/rendering.md says how the map was made.

namespace vantage {

/// Colour of a value in [0, 1], from cool to warm: blue, cyan, green, yellow, red. Nine control
/// colours of our own, joined linearly in OKLab (Ottosson, 2020), where equal steps look about
/// equal. Values outside are clamped; NaN is grey.
Rgb8 cool_warm(double value);

/// Colours of a map scaled linearly from its least to its largest finite value. Flat maps are all
/// cool; infinities take the colour of their end, NaN is grey.
std::vector<Rgb8> colour_map(std::span<const double> values);

}  // namespace vantage
