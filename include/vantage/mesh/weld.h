// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// A surface in which no two vertices share a position, and how to get back.
struct WeldedMesh {
  TriMesh mesh{};                                 ///< Vertices in order of first appearance.
  std::vector<std::uint32_t> welded_of_vertex{};  ///< For each input vertex its vertex in `mesh`.
  std::size_t merged_vertices = 0;                ///< Input vertices that had an earlier twin.
  std::size_t dropped_faces = 0;                  ///< Faces that named one position twice.
};

/// Merges vertices with exactly equal positions (−0 equals 0) and drops the faces this, or the
/// input, makes name a vertex twice. Order of vertices and faces is kept. Each face starts at its
/// lowest vertex: which corner a file names first must not show in the rounding of what follows,
/// which the late steps of a contraction magnify. \throw Cancelled
WeldedMesh weld(const TriMesh& mesh, const RunContext& run = {});

}  // namespace vantage
