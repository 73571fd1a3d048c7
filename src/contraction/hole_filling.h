// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Triangles that close every hole of those components that lack little of a closed surface, as scans do
/// where the scanner did not reach, wound as the faces around them. Components stay as they are that would stay
/// open, or whose holes are large, as those of a bowl, a sheet or a tent.
std::vector<Triangle> fill_holes(const TriMesh& mesh);

}  // namespace vantage
