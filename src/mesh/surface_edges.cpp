// SPDX-License-Identifier: MIT
#include "mesh/surface_edges.h"

#include <cstddef>

#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"

namespace vantage {
SurfaceEdges surface_edges(const TriMesh& mesh) {
  SurfaceEdges edges;
  edges.table = build_edge_table(mesh);
  edges.of_face.resize(mesh.triangles.size());
  std::vector<std::uint8_t> filled(mesh.triangles.size(), 0);
  DisjointSets shells(mesh.triangles.size());
  for (std::uint32_t e = 0; e < edges.table.edges.size(); ++e) {
    const auto faces = edges.table.faces_of_edge[e];
    const auto& [low, high] = edges.table.edges[e];
    const bool is_pair = faces.size() == 2;
    const bool is_alike = is_pair && runs_from(mesh.triangles[faces[0]], low, high) ==
                                         runs_from(mesh.triangles[faces[1]], low, high);
    edges.pairs.push_back(!is_pair   ? EdgePair::None
                          : is_alike ? EdgePair::Same
                                     : EdgePair::Opposite);
    edges.beside.push_back({faces[0], faces.back()});
    for (const std::uint32_t f : faces) {
      edges.of_face[f][filled[f]++] = e;
      shells.join(faces[0], f);
    }
  }
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    edges.shell_of_face.push_back(shells.root(f));
  }
  return edges;
}

}  // namespace vantage
