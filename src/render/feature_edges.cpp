// SPDX-License-Identifier: MIT
#include "render/feature_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Whether the faces at an edge make a feature of it. A face without area says nothing.
bool is_feature(const TriMesh& mesh, const Edge& edge, std::span<const std::uint32_t> faces,
                double crease_cosine) {
  if (faces.size() != 2) {
    return true;
  }
  const Vec3 a = area_vector(mesh, mesh.triangles[faces[0]]);
  const Vec3 b = area_vector(mesh, mesh.triangles[faces[1]]);
  const double lengths = a.norm() * b.norm();
  const bool against =
      runs_from(mesh.triangles[faces[0]], edge[0], edge[1]) ==
      runs_from(mesh.triangles[faces[1]], edge[0], edge[1]);  // wound against each other
  return lengths > 0.0 && (against ? -a.dot(b) : a.dot(b)) < crease_cosine * lengths;
}

/// The edges whose connected piece is long enough in all.
std::vector<Edge> long_pieces(const TriMesh& mesh, const std::vector<Edge>& edges,
                              double least_length) {
  const auto length_of = [&](const Edge& edge) {
    return (mesh.positions[edge[0]] - mesh.positions[edge[1]]).norm();
  };
  DisjointSets sets(mesh.positions.size());
  for (const Edge& edge : edges) {
    sets.join(edge[0], edge[1]);
  }
  std::vector<double> length(mesh.positions.size(), 0.0);
  for (const Edge& edge : edges) {
    length[sets.root(edge[0])] += length_of(edge);
  }
  std::vector<Edge> kept;
  for (const Edge& edge : edges) {
    if (length[sets.root(edge[0])] >= least_length) {
      kept.push_back(edge);
    }
  }
  return kept;
}

/// Without faces that lie on others, as the two sides of a leaf do in some files: they would make
/// each of their edges a branch.
TriMesh without_doubles(TriMesh mesh) {
  std::vector<std::array<std::uint32_t, 4>> keys;  // sorted corners, then the face
  keys.reserve(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle corners = mesh.triangles[f];
    std::sort(corners.begin(), corners.end());
    keys.push_back({corners[0], corners[1], corners[2], f});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || !std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin())) {
      kept.push_back(keys[i][3]);
    }
  }
  std::sort(kept.begin(), kept.end());
  std::vector<Triangle> triangles;
  triangles.reserve(kept.size());
  for (const std::uint32_t f : kept) {
    triangles.push_back(mesh.triangles[f]);
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

void add_split(CurveGraph& graph, const Vec3& from, const Vec3& to, double longest_piece) {
  constexpr double kMostPieces = 1000.0;
  const double length = (to - from).norm();
  const double wanted = length > 0.0 ? std::ceil(length / longest_piece) : 1.0;
  const auto pieces = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, kMostPieces));
  const auto first = static_cast<std::uint32_t>(graph.nodes.size());
  for (std::uint32_t i = 0; i <= pieces; ++i) {
    graph.nodes.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
    if (i > 0) {
      graph.edges.push_back({first + i - 1, first + i});
    }
  }
}

}  // namespace

CurveGraph feature_edges(const TriMesh& mesh, double crease_rad, double least_length,
                         double longest_piece) {
  const TriMesh joined = without_doubles(weld(mesh).mesh);
  const EdgeTable table = build_edge_table(joined);
  const double crease_cosine = std::cos(crease_rad);
  std::vector<Edge> edges;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    if (is_feature(joined, table.edges[e], table.faces_of_edge[e], crease_cosine)) {
      edges.push_back(table.edges[e]);
    }
  }
  edges = long_pieces(joined, edges, least_length);
  CurveGraph graph;
  if (edges.size() > kMostFeatureEdges) {
    return graph;
  }
  double length = 0.0;
  for (const Edge& edge : edges) {
    length += (joined.positions[edge[1]] - joined.positions[edge[0]]).norm();
  }
  longest_piece = std::max(longest_piece, length / static_cast<double>(kMostFeatureEdges));
  for (const Edge& edge : edges) {
    add_split(graph, joined.positions[edge[0]], joined.positions[edge[1]], longest_piece);
  }
  return graph;
}

}  // namespace vantage
