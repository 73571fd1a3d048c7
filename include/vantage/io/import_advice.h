// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vantage/io/import_stream.h"

namespace vantage {

/// What to do with a file of the format where it cannot be read, in a sentence.
constexpr std::string_view import_advice(const ImportFormat& format) {
  return format.name == "blend" ? "export it as GLB from Blender"
         : format.solid
             ? "convert it to STL or OBJ first, for example with FreeCAD or gmsh"
             : "convert it to OBJ, PLY or GLB first, for example with meshlab or Blender";
}

}  // namespace vantage
