// SPDX-License-Identifier: MIT
#include "mesh/pieces.h"

#include "vantage/mesh/topology.h"

#include "mesh/triangle_corners.h"

namespace vantage {

Pieces cut_into_pieces(const TriMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  const Components components = connected_components(mesh);
  const std::vector<bool> has_faces = vertices_with_faces(mesh);
  std::vector<std::uint32_t> piece_of_component(components.count, Pieces::kIsolated);
  Pieces pieces;
  pieces.of_vertex.assign(n, Pieces::kIsolated);
  pieces.local.assign(n, 0);
  for (std::uint32_t v = 0; v < n; ++v) {
    if (!has_faces[v]) {
      continue;
    }
    std::uint32_t& p = piece_of_component[components.of_vertex[v]];
    if (p == Pieces::kIsolated) {
      p = static_cast<std::uint32_t>(pieces.all.size());
      pieces.all.emplace_back();
    }
    pieces.of_vertex[v] = p;
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
