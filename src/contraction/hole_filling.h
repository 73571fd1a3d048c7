// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Closes every hole of those parts that lack little of a closed surface, as scans do where the scanner did
/// not reach: by triangles around a vertex in its middle, which come last, wound as the faces around them.
/// A part is what hangs together over edges. It stays as it is if it would stay open, or if its holes are
/// large, as those of a bowl, a sheet or a tent, or of a flap that hangs on a vertex. \return how many holes
/// were closed.
std::size_t fill_holes(TriMesh& mesh);

}  // namespace vantage
