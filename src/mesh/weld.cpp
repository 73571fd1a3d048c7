// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tuple>

#include "vantage/mesh/mesh_check.h"

#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// For each point the lowest index among the points at its position.
std::vector<std::uint32_t> first_of_position(const std::vector<Vec3>& points) {
  // Sorted by x first, in one run of memory: few points share it, so few others are looked up.
  struct Key {
    double x = 0.0;
    std::uint32_t point = 0;
  };

  std::vector<Key> keys(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    keys[v] = {points[v].x(), v};
  }
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    if (a.x != b.x) {
      return a.x < b.x;
    }
    const Vec3& p = points[a.point];
    const Vec3& q = points[b.point];
    return std::tie(p.y(), p.z(), a.point) < std::tie(q.y(), q.z(), b.point);
  });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::uint32_t v = keys[i].point;
    const bool same = i > 0 && points[v] == points[keys[i - 1].point];
    first[v] = same ? first[keys[i - 1].point] : v;
  }
  return first;
}

}  // namespace

WeldedMesh weld(const TriMesh& mesh, const RunContext& run) {
  run.check();
  const std::size_t vertex_count = mesh.positions.size();
  const std::vector<std::uint32_t> first = first_of_position(mesh.positions);
  run.check();
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
    if (names_a_vertex_twice(triangle)) {
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
