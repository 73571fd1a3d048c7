// SPDX-License-Identifier: MIT
#include "vantage/mesh/weld.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace vantage {
namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

WeldedMesh weld(const TriMesh& mesh, const RunContext& run) {
  run.check();
  const std::size_t vertex_count = mesh.positions.size();
  std::vector<std::uint32_t> order(vertex_count);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3& p = mesh.positions[a];
    const Vec3& q = mesh.positions[b];
    return p == q ? a < b : before(p, q);
  });

  run.check();

  // The first of each run of equal positions has the lowest index and stands for the run.
  std::vector<std::uint32_t> first(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) {
    const bool same = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }

  WeldedMesh welded;
  welded.welded_of_vertex.resize(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (first[v] == v) {
      welded.welded_of_vertex[v] = static_cast<std::uint32_t>(welded.mesh.positions.size());
      welded.mesh.positions.push_back(mesh.positions[v]);
    } else {
      welded.welded_of_vertex[v] = welded.welded_of_vertex[first[v]];
      ++welded.merged_vertices;
    }
  }
  run.check();
  welded.mesh.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    Triangle triangle{welded.welded_of_vertex[a], welded.welded_of_vertex[b],
                      welded.welded_of_vertex[c]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      ++welded.dropped_faces;
    } else {
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                  triangle.end());
      welded.mesh.triangles.push_back(triangle);
    }
  }
  return welded;
}

}  // namespace vantage
