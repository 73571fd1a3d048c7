// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// Vertex indices of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle set. Nothing is assumed beyond valid indices: it may be open, have several
/// components, non-manifold edges, duplicated positions, zero-area faces, isolated vertices.
struct TriMesh {
  std::vector<Vec3> positions{};      ///< |V| finite points, in model units.
  std::vector<Triangle> triangles{};  ///< |F| triples of indices below |V|.
};

/// Which side of a face can be seen.
enum class FaceSides {
  Front,  ///< Only the side the winding points to: closed, consistently wound shells.
  Both,   ///< Both: open, inconsistently wound or non-manifold surfaces.
};

}  // namespace vantage
