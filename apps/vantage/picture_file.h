// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/image.h"

/// \file
/// Pictures under the name that the user gave.

namespace vantage::cli {

/// Refuses names of picture formats that are not written: anything but .webp becomes a PNG, because
/// file managers ask for thumbnails under temporary names. \throw CLI::ValidationError
std::string checked_picture_name(const std::string& path, const std::string& option);

/// A WebP if the name ends so, else a PNG. \throw IoError, InvalidInput
std::string picture_bytes(const std::string& path, const Image& image);

/// Refuses sides, in pixels, that a file of that name cannot hold. \param option that says them.
/// \throw CLI::ValidationError
void check_sides(const std::string& path, int width, int height,
                 const std::string& option = "--size");

/// Refuses 16 bit for a name that means another format than PNG. \throw CLI::ValidationError
void check_depth(const std::string& path, int depth);

}  // namespace vantage::cli
