// SPDX-License-Identifier: MIT
#include "vantage/mesh/topology.h"

#include <algorithm>
#include <tuple>

#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// A face at an edge whose lower end is known.
struct EdgeUse {
  std::uint32_t b, face;

  bool operator<(const EdgeUse& other) const {
    return std::tie(b, face) < std::tie(other.b, other.face);
  }
};

/// Calls visit(a, b, face) for each side of each face, a < b.
template <class Visit>
void for_each_side(const TriMesh& mesh, Visit&& visit) {
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    if (names_a_vertex_twice(t)) {
      continue;
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = t[corner];
      const std::uint32_t b = t[(corner + 1) % 3];
      visit(std::min(a, b), std::max(a, b), f);
    }
  }
}

}  // namespace

EdgeTable build_edge_table(const TriMesh& mesh) {
  std::uint32_t vertices = 0;  // the positions may be missing
  for (const Triangle& t : mesh.triangles) {
    vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  }
  // By counting into one list per lower end; sorting all at once takes several times as long.
  std::vector<std::uint32_t> offsets(std::size_t{vertices} + 1, 0);
  for_each_side(mesh, [&](std::uint32_t a, std::uint32_t, std::uint32_t) { ++offsets[a + 1]; });
  for (std::size_t v = 1; v < offsets.size(); ++v) {
    offsets[v] += offsets[v - 1];
  }
  std::vector<EdgeUse> uses(offsets.back());
  std::vector<std::uint32_t> cursor(offsets.begin(), offsets.end() - 1);
  for_each_side(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t f) {
    uses[cursor[a]++] = {b, f};
  });

  EdgeTable table;
  table.faces_of_edge.values.reserve(uses.size());
  table.faces_of_edge.offsets.reserve(uses.size() / 2 + 1);  // as many as if it were closed
  table.edges.reserve(uses.size() / 2);
  for (std::uint32_t a = 0; a < vertices; ++a) {
    std::sort(uses.begin() + offsets[a], uses.begin() + offsets[a + 1]);
    for (std::size_t i = offsets[a]; i < offsets[a + 1]; ++i) {
      if (i == offsets[a] || uses[i].b != uses[i - 1].b) {
        if (i > 0) {
          table.faces_of_edge.offsets.push_back(static_cast<std::uint32_t>(i));
        }
        table.edges.push_back({a, uses[i].b});
      }
      table.faces_of_edge.values.push_back(uses[i].face);
    }
  }
  if (!uses.empty()) {
    table.faces_of_edge.offsets.push_back(static_cast<std::uint32_t>(uses.size()));
  }
  return table;
}

IndexLists vertex_neighbours(const TriMesh& mesh) {
  return vertex_neighbours(build_edge_table(mesh), mesh.positions.size());
}

IndexLists vertex_neighbours(const EdgeTable& table, std::size_t vertex_count) {
  std::vector<std::uint32_t> degree(vertex_count + 1, 0);
  for (const auto& [a, b] : table.edges) {
    ++degree[a + 1];
    ++degree[b + 1];
  }
  IndexLists rings;
  rings.offsets.resize(degree.size());
  for (std::size_t v = 1; v < degree.size(); ++v) {
    rings.offsets[v] = rings.offsets[v - 1] + degree[v];
  }
  rings.values.resize(2 * table.edges.size());
  std::vector<std::uint32_t> cursor(rings.offsets.begin(), rings.offsets.end() - 1);
  // Edges are sorted by (a, b): every vertex first receives its lower, then its higher neighbours.
  for (const auto& [a, b] : table.edges) {
    rings.values[cursor[b]++] = a;
  }
  for (const auto& [a, b] : table.edges) {
    rings.values[cursor[a]++] = b;
  }
  return rings;
}

IndexLists vertex_faces(const TriMesh& mesh) {
  IndexLists faces;
  faces.offsets.assign(mesh.positions.size() + 1, 0);
  const auto for_each_corner = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      visit(t[0], f);
      if (t[1] != t[0]) {
        visit(t[1], f);
      }
      if (t[2] != t[0] && t[2] != t[1]) {
        visit(t[2], f);
      }
    }
  };
  for_each_corner([&](std::uint32_t v, std::uint32_t) { ++faces.offsets[v + 1]; });
  for (std::size_t v = 1; v < faces.offsets.size(); ++v) {
    faces.offsets[v] += faces.offsets[v - 1];
  }
  faces.values.resize(faces.offsets.back());
  std::vector<std::uint32_t> cursor(faces.offsets.begin(), faces.offsets.end() - 1);
  for_each_corner([&](std::uint32_t v, std::uint32_t f) { faces.values[cursor[v]++] = f; });
  return faces;
}

Components connected_components(const TriMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(b, c);
  }
  Components components;
  components.of_vertex.resize(mesh.positions.size());
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t root = sets.root(v);
    components.of_vertex[v] =
        root == v ? static_cast<std::uint32_t>(components.count++) : components.of_vertex[root];
  }
  return components;
}

std::vector<bool> vertices_with_faces(const TriMesh& mesh) {
  std::vector<bool> named(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles) {
    if (!names_a_vertex_twice(t)) {
      named[t[0]] = named[t[1]] = named[t[2]] = true;
    }
  }
  return named;
}

std::vector<std::uint32_t> count_fans(const TriMesh& mesh) {
  const IndexLists faces_of = vertex_faces(mesh);
  std::vector<std::uint32_t> fans(mesh.positions.size(), 0);
  std::vector<std::array<std::uint32_t, 2>>
      spokes;  // other end of a side at the vertex, face there
  for (std::uint32_t v = 0; v < fans.size(); ++v) {
    spokes.clear();
    std::uint32_t faces = 0;
    for (const std::uint32_t f : faces_of[v]) {
      const Triangle& t = mesh.triangles[f];
      if (!names_a_vertex_twice(t)) {
        const std::size_t corner = corner_at(t, v);
        spokes.push_back({t[(corner + 1) % 3], faces});
        spokes.push_back({t[(corner + 2) % 3], faces});
        ++faces;
      }
    }
    std::sort(spokes.begin(), spokes.end());
    DisjointSets groups(faces);
    fans[v] = faces;
    for (std::size_t i = 1; i < spokes.size(); ++i) {
      if (spokes[i][0] == spokes[i - 1][0] && groups.join(spokes[i - 1][1], spokes[i][1])) {
        --fans[v];
      }
    }
  }
  return fans;
}

}  // namespace vantage
