// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "stream_writer.h"

/// \file
/// The readers of others. Each sends a whole stream but its end, or throws std::exception with the reason.

namespace vantage::importing {

/// Exact solids by Open CASCADE: "step", "iges" or "brep", tessellated.
/// \param descriptor of the file, open, at its start; \param bytes the same.
void read_solid(std::string_view format, int descriptor, std::string_view bytes, StreamWriter& out);

/// Everything else by Assimp. \param extension one of kImportFormats.
void read_scene(std::string_view extension, std::string_view bytes, StreamWriter& out);

/// Versions, e.g. "Open CASCADE 7.6.3".
std::string solid_library();
std::string scene_library();

}  // namespace vantage::importing
