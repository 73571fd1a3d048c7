// SPDX-License-Identifier: MIT
#include "mesh/pieces.h"

#include "vantage/mesh/topology.h"

#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"

namespace vantage {

Pieces cut_into_pieces(const TriMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  const std::vector<bool> has_faces = vertices_with_faces(mesh);
  // Without the faces that name a vertex twice, which would join two components.
  DisjointSets sets(n);
  for (const Triangle& t : mesh.triangles) {
    if (!names_a_vertex_twice(t)) {
      sets.join(t[0], t[1]);
      sets.join(t[1], t[2]);
    }
  }
  Pieces pieces;
  pieces.of_vertex.assign(n, Pieces::kIsolated);
  pieces.local.assign(n, 0);
  for (std::uint32_t v = 0; v < n; ++v) {
    if (!has_faces[v]) {
      continue;
    }
    if (sets.root(v) == v) {
      pieces.of_vertex[v] = static_cast<std::uint32_t>(pieces.all.size());
      pieces.all.emplace_back();
    }
    const std::uint32_t p = pieces.of_vertex[v] = pieces.of_vertex[sets.root(v)];
    pieces.local[v] = static_cast<std::uint32_t>(pieces.all[p].vertices.size());
    pieces.all[p].vertices.push_back(v);
  }
  const auto& local = pieces.local;
  for (const Triangle& t : mesh.triangles) {
    if (!names_a_vertex_twice(t)) {
      Piece& piece = pieces.all[pieces.of_vertex[t[0]]];
      piece.triangles.push_back({local[t[0]], local[t[1]], local[t[2]]});
    }
  }
  return pieces;
}

}  // namespace vantage
