// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Triangles that close the holes of three edges in a surface, wound as the faces around them; of no
/// area where an edge meets two, which leaves a crack. A skeleton cannot tell such a hole from a handle.
/// Holes stay open that have an edge above a fifth of the distance from the mean of their component's
/// vertices to the farthest: that is how a tent or a box without its lid is made.
std::vector<Triangle> missing_triangles(const TriMesh& mesh);

}  // namespace vantage
