// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Topology as values computed from triangles, in compressed rows (offsets + values).

namespace vantage {

/// For each row a run of indices: row i is values[offsets[i] .. offsets[i+1]).
struct IndexLists {
  std::vector<std::uint32_t> offsets{0};  ///< rows + 1 entries.
  std::vector<std::uint32_t> values{};    ///< All rows, one after the other.

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }  ///< Number of rows.

  /// Values of a row.
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t row) const {
    return {values.data() + offsets[row], offsets[row + 1] - offsets[row]};
  }
};

/// Undirected edges with the faces at each. Edges of faces that name a vertex twice are left out.
struct EdgeTable {
  std::vector<std::array<std::uint32_t, 2>> edges{};  ///< Pairs a < b, lexicographically sorted.
  IndexLists faces_of_edge{};                         ///< Faces at each edge, ascending.
};

/// All edges of `mesh`.
EdgeTable build_edge_table(const TriMesh& mesh);

/// The one-ring of each vertex: vertices that share an edge with it, ascending.
IndexLists vertex_neighbours(const TriMesh& mesh);

/// The same from a mesh's edges, if they are at hand.
IndexLists vertex_neighbours(const EdgeTable& table, std::size_t vertex_count);

/// The faces at each vertex, ascending; a face that names a vertex twice is listed once.
IndexLists vertex_faces(const TriMesh& mesh);

/// Whether a face with three different corners names each vertex.
std::vector<bool> vertices_with_faces(const TriMesh& mesh);

/// For each vertex the number of fans: groups of its faces that hang together over shared edges.
std::vector<std::uint32_t> count_fans(const TriMesh& mesh);

/// Label of the connected component of each vertex, numbered by lowest vertex index; vertices that
/// no face names are components of their own.
struct Components {
  std::vector<std::uint32_t> of_vertex{};  ///< |V| labels.
  std::size_t count = 0;                   ///< Number of labels.
};

/// Components of the surface by shared vertices.
Components connected_components(const TriMesh& mesh);

}  // namespace vantage
