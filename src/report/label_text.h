// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vantage/core/image.h"

/// \file
/// Short labels in pictures.

namespace vantage {

/// Height of a line of text with its descenders, px.
inline constexpr int kTextHeight = 22;

/// Width of a text, px.
int text_width(std::string_view text);

/// Writes a text in dark strokes, its left top corner at (left, top); what does not fit is cut off.
/// Letters (as small ones), digits, hyphen and full stop; anything else is a space.
void write_text(Image& image, std::string_view text, int left, int top);

}  // namespace vantage
