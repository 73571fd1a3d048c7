// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/image.h"
#include "vantage/core/run_context.h"

namespace vantage {

/// A smaller copy: means over areas, of light times opacity. \pre 0 < width ≤ that of the image, and
/// the same for the height. \throw Cancelled
Image smaller_picture(const Image& image, int width, int height, const RunContext& run);

}  // namespace vantage
