// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Closes every hole of those components that lack little of a closed surface, as scans do where the scanner did
/// not reach: by triangles around a vertex in its middle, which come last, wound as the faces around them.
/// Components stay as they are that would stay open, or whose holes are large, as those of a bowl, a sheet or a
/// tent. \return how many holes were closed.
std::size_t fill_holes(TriMesh& mesh);

}  // namespace vantage
