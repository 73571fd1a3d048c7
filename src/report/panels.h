// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/image.h"

namespace vantage {

/// A share for captions: "12.3 %".
std::string percent_text(double share);

/// The picture with a line of ASCII text on white below it; the text shrinks until it fits.
Image with_caption(const Image& panel, std::string_view text);

/// The pictures row by row on white, a gap between them and around.
/// \pre all are of one size, columns ≥ 1. \throw InvalidInput if they are not, or there are none.
Image in_rows(const std::vector<Image>& panels, std::size_t columns);

}  // namespace vantage
