// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

namespace vantage {

/// A surface without isolated vertices and broken faces, as decimate() wants it.
struct CompactSurface {
  TriMesh mesh{};                              ///< Its vertices are called rows.
  std::vector<std::uint32_t> vertex_of_row{};  ///< The vertex that each row was, ascending.
  std::vector<FaceSides> sides{};              ///< One per component of `mesh`.
};

/// Leaves out vertices that no face names and faces that name a vertex twice.
/// \param sides one per component of `surface`.
CompactSurface compact_surface(const TriMesh& surface, const std::vector<FaceSides>& sides);

}  // namespace vantage
