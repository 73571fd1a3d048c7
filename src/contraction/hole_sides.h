// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// A side of a hole: the edge of one face, run through as a face in the hole would.
struct HoleSide {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t face = 0;  ///< On its other side.
};

/// The sides of all holes, by where they begin, then by where they end.
std::vector<HoleSide> hole_sides(const TriMesh& mesh, const EdgeTable& table);

}  // namespace vantage
