// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/readers.h"

/// \file
/// Paths as OBJ, MTL and PLY write them.

namespace vantage {

/// Programs of Windows write backslashes.
std::string with_slashes(std::string_view name);

/// A relative path with slashes as the file names it; nothing if it leaves the folder.
std::optional<std::string> inside_folder(const std::string& path);

/// Where a picture or a library may be, relative to the model's folder: as it is named, or beside the model, as
/// the path is often one of the author's own disk. \param named with slashes.
std::vector<std::string> places_of_file(const std::string& named);

/// The first of these where there is one, else the last; nothing if none is inside. \param exists empty: there
/// are no files.
std::optional<std::string> place_of_picture(const std::string& named, const SideFileCheck& exists);

}  // namespace vantage
