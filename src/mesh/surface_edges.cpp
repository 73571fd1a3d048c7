// SPDX-License-Identifier: MIT
#include "mesh/surface_edges.h"

#include <algorithm>
#include <cstddef>

#include "mesh/disjoint_sets.h"

namespace vantage {
namespace {

/// Whether the face runs along the edge from its lower to its higher vertex.
bool runs_up(const Triangle& face, const std::array<std::uint32_t, 2>& edge) {
  const auto at = std::find(face.begin(), face.end(), edge[0]) - face.begin();
  return face[static_cast<std::size_t>(at + 1) % 3] == edge[1];
}

}  // namespace

SurfaceEdges surface_edges(const TriMesh& mesh) {
  SurfaceEdges edges;
  edges.table = build_edge_table(mesh);
  edges.of_face.resize(mesh.triangles.size());
  std::vector<std::uint8_t> filled(mesh.triangles.size(), 0);
  DisjointSets shells(mesh.triangles.size());
  for (std::uint32_t e = 0; e < edges.table.edges.size(); ++e) {
    const auto faces = edges.table.faces_of_edge[e];
    const auto& ends = edges.table.edges[e];
    const bool is_pair = faces.size() == 2;
    const bool is_alike = is_pair && runs_up(mesh.triangles[faces[0]], ends) ==
                                         runs_up(mesh.triangles[faces[1]], ends);
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

std::vector<std::uint8_t> vertices_of_several_fans(const TriMesh& mesh, const EdgeTable& edges) {
  const auto corner_at = [&](std::uint32_t face, std::uint32_t vertex) {
    const Triangle& t = mesh.triangles[face];
    const auto k = std::find(t.begin(), t.end(), vertex) - t.begin();
    return 3 * face + static_cast<std::uint32_t>(k);
  };
  DisjointSets fans(3 * mesh.triangles.size());  // of corners
  for (std::uint32_t e = 0; e < edges.edges.size(); ++e) {
    const auto faces = edges.faces_of_edge[e];
    for (const std::uint32_t end : edges.edges[e]) {
      for (const std::uint32_t f : faces) {
        fans.join(corner_at(faces[0], end), corner_at(f, end));
      }
    }
  }
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> fan(mesh.positions.size(), kNone);
  std::vector<std::uint8_t> has_several(mesh.positions.size(), 0);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t vertex : mesh.triangles[f]) {
      const std::uint32_t own = fans.root(corner_at(f, vertex));
      if (fan[vertex] != kNone && fan[vertex] != own) {
        has_several[vertex] = 1;
      }
      fan[vertex] = own;
    }
  }
  return has_several;
}

}  // namespace vantage
