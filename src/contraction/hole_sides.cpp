// SPDX-License-Identifier: MIT
#include "contraction/hole_sides.h"

#include <algorithm>
#include <tuple>

#include "mesh/triangle_corners.h"

namespace vantage {

std::vector<HoleSide> hole_sides(const TriMesh& mesh, const EdgeTable& table) {
  std::vector<HoleSide> sides;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    if (const auto faces = table.faces_of_edge[e]; faces.size() == 1) {
      const auto [a, b] = table.edges[e];
      const bool is_against = runs_from(mesh.triangles[faces[0]], a, b);
      sides.push_back({is_against ? b : a, is_against ? a : b, faces[0]});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const HoleSide& a, const HoleSide& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  return sides;
}

}  // namespace vantage
