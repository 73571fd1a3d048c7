// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/readers.h"

/// \file
/// Paths as OBJ, MTL and PLY write them.

namespace vantage {

/// Programs of Windows write backslashes.
std::string with_slashes(std::string_view name);

/// A relative path with slashes as the file names it; nothing if it leaves the folder.
std::optional<std::string> inside_folder(const std::string& path);

/// Where a picture is, relative to the model's folder; nothing if nowhere inside. \param named with
/// slashes. \param files empty: there are none.
std::optional<std::string> place_of_picture(const std::string& named, const SideFileSource& files);

}  // namespace vantage
