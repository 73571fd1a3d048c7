// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// How the faces of a mesh hang together.

namespace vantage {

/// The faces at an edge: two that run along it in opposite ways, as on a surface with two sides; two
/// that run along it the same way; or not two.
enum class EdgePair : std::uint8_t { Opposite, Same, None };

/// Edges of a mesh, numbered as in their table.
struct SurfaceEdges {
  EdgeTable table{};
  std::vector<EdgePair> pairs{};                        ///< Of each edge.
  std::vector<std::array<std::uint32_t, 2>> beside{};   ///< First and last face at each edge.
  std::vector<std::array<std::uint32_t, 3>> of_face{};  ///< The edges of each face.
  std::vector<std::uint32_t> shell_of_face{};  ///< Alike for faces that edges hold together.
};

/// \pre no face names a vertex twice.
SurfaceEdges surface_edges(const TriMesh& mesh);

}  // namespace vantage
