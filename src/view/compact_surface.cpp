// SPDX-License-Identifier: MIT
#include "view/compact_surface.h"

#include "vantage/mesh/topology.h"

#include "mesh/triangle_corners.h"

namespace vantage {

CompactSurface compact_surface(const TriMesh& surface, const std::vector<FaceSides>& sides) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> row(surface.positions.size(), kNone);
  const std::vector<bool> named = vertices_with_faces(surface);
  CompactSurface result;
  result.mesh.triangles = surface.triangles;
  std::erase_if(result.mesh.triangles, names_a_vertex_twice);
  for (std::uint32_t v = 0; v < row.size(); ++v) {
    if (named[v]) {
      row[v] = static_cast<std::uint32_t>(result.vertex_of_row.size());
      result.vertex_of_row.push_back(v);
      result.mesh.positions.push_back(surface.positions[v]);
    }
  }
  for (Triangle& t : result.mesh.triangles) {
    t = {row[t[0]], row[t[1]], row[t[2]]};
  }
  if (sides.size() == 1) {
    result.sides = sides;
    return result;
  }
  // Components are numbered by their lowest vertex, so that those left keep their order.
  const Components before = connected_components(surface);
  const Components after = connected_components(result.mesh);
  result.sides.resize(after.count, FaceSides::Both);
  for (std::size_t r = 0; r < result.vertex_of_row.size(); ++r) {
    result.sides[after.of_vertex[r]] = sides[before.of_vertex[result.vertex_of_row[r]]];
  }
  return result;
}

}  // namespace vantage
