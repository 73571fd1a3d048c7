// SPDX-License-Identifier: MIT
#include "spatial/enclosing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// Faces a vertex, in the mean, beyond which a component encloses nothing, while asking all of them
/// takes minutes: a closed surface has two [ours].
constexpr std::size_t kMostAtVertex = 16;

struct Component {
  std::size_t faces = 0;
  std::size_t vertices = 0;
  bool has_even_edges = true;  ///< As many faces at each edge as make a closed surface.
  bool is_wound_alike = true;  ///< As many of them run along it one way as the other.
  Vec3 origin = Vec3::Zero();  ///< One of its vertices.
  double six_volumes = 0.0;
  double area = 0.0;
  double size = 0.0;  ///< Largest distance from there.
};

/// Whether as many faces run along the edge one way as the other.
bool is_balanced(const std::array<std::uint32_t, 2>& edge, std::span<const std::uint32_t> faces,
                 const TriMesh& mesh) {
  std::ptrdiff_t sum = 0;
  for (const std::uint32_t f : faces) {
    const auto& [a, b, c] = mesh.triangles[f];
    const bool is_forth = (a == edge[0] && b == edge[1]) || (b == edge[0] && c == edge[1]) ||
                          (c == edge[0] && a == edge[1]);
    sum += is_forth ? 1 : -1;
  }
  return sum == 0;
}

bool is_flat(const Component& part) {
  return part.is_wound_alike &&
         std::abs(part.six_volumes) / 6.0 <= kFlatShell * part.area * part.size;
}

}  // namespace

std::vector<std::uint8_t> open_components(const TriMesh& mesh, const EdgeTable& table,
                                          std::span<const std::uint32_t> component_of_vertex) {
  std::vector<Component> parts;
  const auto part_of = [&](std::uint32_t vertex) -> Component& {
    return parts[component_of_vertex[vertex]];
  };
  for (const Triangle& t : mesh.triangles) {
    if (names_a_vertex_twice(t)) {
      continue;  // its corners may be of no component
    }
    parts.resize(std::max(parts.size(), component_of_vertex[t[0]] + std::size_t{1}));
    Component& part = part_of(t[0]);
    if (part.faces++ == 0) {
      part.origin = mesh.positions[t[0]];
    }
    const Vec3 a = mesh.positions[t[0]] - part.origin;
    const Vec3 b = mesh.positions[t[1]] - part.origin;
    const Vec3 c = mesh.positions[t[2]] - part.origin;
    part.six_volumes += a.dot(b.cross(c));
    part.area += 0.5 * (b - a).cross(c - a).norm();
    part.size = std::max({part.size, a.norm(), b.norm(), c.norm()});
  }
  for (const std::uint32_t component : component_of_vertex) {
    if (component < parts.size()) {  // not a lone vertex
      ++parts[component].vertices;
    }
  }
  std::vector<std::uint8_t> is_open(parts.size(), 1);  // what has no edge has no inside
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    Component& part = part_of(table.edges[e][0]);
    const std::span<const std::uint32_t> faces = table.faces_of_edge[e];
    part.has_even_edges = part.has_even_edges && faces.size() % 2 == 0;
    part.is_wound_alike = part.is_wound_alike && is_balanced(table.edges[e], faces, mesh);
    is_open[component_of_vertex[table.edges[e][0]]] = 0;
  }
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (!parts[c].has_even_edges || parts[c].faces > kMostAtVertex * parts[c].vertices ||
        is_flat(parts[c])) {
      is_open[c] = 1;
    }
  }
  return is_open;
}

}  // namespace vantage
