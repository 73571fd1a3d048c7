// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "visibility/surface.h"
#include "visibility/surface_edges.h"

/// \file
/// Faces whose backs need not be asked what they hide. A shell is made of faces that edges hold
/// together. On a closed one that is wound outwards and nowhere meets itself, a line of sight that
/// passes a back enters the shell, and to reach an eye outside it must leave through a front: what
/// the back hides that front hides too, whatever other shells do.

namespace vantage {

/// 1 for each face whose back may hide something that no front hides, from an eye outside.
std::vector<std::uint8_t> hiding_backs(const Surface& surface, const SurfaceEdges& edges);

}  // namespace vantage
