// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

/// \file
/// A typeface of strokes, ours, so that pictures can be lettered without a font of the system.

namespace vantage {

/// A line through points in the plane, x to the right, y up.
using Stroke = std::vector<std::array<double, 2>>;

/// The strokes of a line of ASCII text of cap height 1, its baseline from (0, 0) to the right; other
/// characters leave a gap.
std::vector<Stroke> letter_strokes(std::string_view text);

/// Width of the same, from where it begins to where the next letter would.
double lettering_width(std::string_view text);

}  // namespace vantage
