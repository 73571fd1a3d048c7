// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Triangles that close the holes of three edges in a surface, wound as the faces around them; of no area where an
/// edge meets two, which leaves a crack. A skeleton cannot tell such a hole from a handle. Holes with an edge of a tenth of their component or more stay open: that is how
/// a tent or a box without its lid is made.
std::vector<Triangle> missing_triangles(const TriMesh& mesh);

}  // namespace vantage
