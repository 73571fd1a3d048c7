// SPDX-License-Identifier: MIT
// What is wrong with a surface? Six triangles as a program might write them, each with corners of its own.
#include "vantage/mesh/mesh_check.h"

#include <cstdio>

#include "vantage/mesh/measures.h"

int main() {
  using namespace vantage;
  // A bipyramid, torn apart.
  const std::vector<Vec3> corners{{0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, -1}};
  const std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1},
                                    {4, 2, 1}, {4, 3, 2}, {4, 1, 3}};
  TriMesh soup;
  for (const Triangle& face : faces) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t corner : face) {
      soup.positions.push_back(corners[corner]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const MeshReport torn = check_mesh(soup);
  const MeshReport whole = check_mesh(weld(soup).mesh);
  std::printf(
      "as given: %zu components, %zu boundary edges; welded: %zu, %s, genus %zu, area %.3f\n",
      torn.components, torn.boundary_edges, whole.components, whole.closed ? "closed" : "open",
      whole.genus.value_or(0), surface_area(soup));
  return torn.components == 6 && whole.closed && whole.genus == 0U ? 0 : 1;
}
