// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Which components of a surface enclose something.

namespace vantage {

/// A shell whose volume is below this share of area times size has no inside to speak of. [ours]
inline constexpr double kFlatShell = 1e-12;

/// Of each component 1 if it has no inside: an edge of an odd number of faces, too many faces to ask, or
/// two sides that lie on each other, as those of paper and leaves.
std::vector<std::uint8_t> open_components(const TriMesh& mesh, const EdgeTable& table,
                                          std::span<const std::uint32_t> component_of_vertex);

}  // namespace vantage
