// SPDX-License-Identifier: MIT
// Which vertices of plain triangles does an eye see? No model file, no method: one call.
#include <cstdio>

#include "vantage/visibility/vertex_visibility.h"

int main() {
  using namespace vantage;
  // A tetrahedron with its right angle at the origin.
  const TriMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const std::vector<std::uint8_t> visible = visible_vertices(mesh, Vec3(5, 5, 5));
  for (std::size_t v = 0; v < visible.size(); ++v) {
    std::printf("vertex %zu is %s\n", v, visible[v] != 0 ? "visible" : "hidden");
  }
  // Only the corner at the origin is behind the face of the other three.
  const bool as_expected = visible[0] == 0 && visible[1] == 1 && visible[2] == 1 && visible[3] == 1;
  return as_expected ? 0 : 1;
}
