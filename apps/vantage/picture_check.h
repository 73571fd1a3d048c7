// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/image.h"

namespace vantage::cli {

/// Why a picture of a model cannot be what was wanted, in a sentence with what to do; empty for one
/// that shows something in a five-hundredth of its pixels or more. Pixels that are as the first of their
/// row show nothing: backgrounds may change from row to row.
std::string emptiness_warning(const Image& picture);
std::string emptiness_warning(const DeepImage& picture);

}  // namespace vantage::cli
