// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// All that can be wrong, or unusual, with a surface. Counts refer to the mesh as given; call
/// weld() first if coincident vertices should count as one.
struct MeshReport {
  std::size_t vertices = 0;               ///< Isolated ones too.
  std::size_t faces = 0;                  ///< Triangles, degenerate ones too.
  std::size_t components = 0;             ///< Of the surface; isolated vertices are not counted.
  std::size_t isolated_vertices = 0;      ///< Named by no face.
  std::size_t duplicate_vertices = 0;     ///< Positions that appeared before.
  std::size_t repeated_index_faces = 0;   ///< Faces that name a vertex twice.
  std::size_t zero_area_faces = 0;        ///< Area at most 1e-12 D², repeated indices included.
  std::size_t duplicate_faces = 0;        ///< Same three vertices as an earlier face.
  std::size_t boundary_edges = 0;         ///< Edges of one face.
  std::size_t boundary_loops = 0;         ///< Connected groups of boundary edges.
  std::size_t non_manifold_edges = 0;     ///< Edges of three or more faces.
  std::size_t non_manifold_vertices = 0;  ///< Vertices whose faces form more than one fan.
  std::size_t inconsistent_edges = 0;     ///< Two-face edges that both faces run the same way.
  bool closed = false;                    ///< Has faces, and every edge has exactly two.
  bool oriented = false;                  ///< Has faces, and no inconsistent or non-manifold edge.
  double signed_volume = 0.0;             ///< Model units³; meaningful when closed and oriented.
  /// Sum over all shells, if the surface is closed and orientable; sheets that only touch in a
  /// vertex are taken apart there.
  std::optional<std::size_t> genus{};
};

/// Looks for every defect in the table above; of a mesh with valid indices there always is a report.
/// \throw Cancelled
MeshReport check_mesh(const TriMesh& mesh, const RunContext& run = {});

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
