// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "vantage/core/image.h"

namespace vantage::batch {

/// Name of the small picture in a model's folder.
inline constexpr const char* kThumbnailFile = "thumb.png";

/// Longest side of a small picture, px.
inline constexpr int kThumbnailSide = 160;

/// The picture made smaller, as by smaller_picture(); its longest side is kThumbnailSide. Pictures that are small already stay as they are.
Image thumbnail_of(const Image& image);

/// Decodes a PNG. Empty if it is none or a side is longer than `longest_side`.
std::optional<Image> parse_png(std::string_view bytes, int longest_side);

}  // namespace vantage::batch
