// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// A smaller copy of a surface, to look at.

namespace vantage {

/// Faces over some of the vertices of a surface.
struct DisplayMesh {
  std::vector<Triangle> triangles{};           ///< Over the rows of vertex_of_row.
  std::vector<std::uint32_t> vertex_of_row{};  ///< Vertex of the surface, ascending.
};

/// How large a copy may be.
struct DisplaySize {
  std::size_t max_faces = 0;     ///< At most about so many.
  std::size_t max_vertices = 0;  ///< At most so many.
};

/// A copy of `surface` of either size, chosen so that it looks alike and more of it is left where
/// the significance is large; vertices stay where they are. The surface itself, less vertices
/// without faces, if it is small enough.
/// \param significance |V| finite values ≥ 0. \param sides one per component.
/// \param sizes the second no larger than the first. \return two. \throw Cancelled
std::vector<DisplayMesh> display_meshes(const TriMesh& surface,
                                        std::span<const double> significance,
                                        const std::vector<FaceSides>& sides,
                                        const std::array<DisplaySize, 2>& sizes,
                                        const RunContext& run = {});

}  // namespace vantage
