// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/image.h"

namespace vantage {

/// Draws what the colours of a map mean, "low", the colours and "high", into the corner of its picture
/// that shows least; into none of a picture too small to read it.
void draw_legend(Image& picture);
void draw_legend(DeepImage& picture);  ///< The same.

}  // namespace vantage
