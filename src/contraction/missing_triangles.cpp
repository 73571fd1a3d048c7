// SPDX-License-Identifier: MIT
#include "contraction/missing_triangles.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "vantage/mesh/topology.h"

#include "contraction/hole_sides.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// The longest edge of a hole that is closed, by the radius of its component [ours].
constexpr double kLongestEdge = 0.2;

/// Sides that begin at a corner of a hole, at most [ours: bounds the work where all faces meet in one vertex].
constexpr std::size_t kMostSides = 8;

/// The sides that begin at a vertex; none where there are so many that it is no part of a sound surface.
std::span<const HoleSide> few_sides_from(std::span<const HoleSide> sides, std::uint32_t vertex) {
  const auto is_before = [&](const HoleSide& side) { return side.from < vertex; };
  const auto is_there = [&](const HoleSide& side) { return side.from == vertex; };
  const auto first = std::partition_point(sides.begin(), sides.end(), is_before);
  const auto last = std::partition_point(first, sides.end(), is_there);
  const auto count = static_cast<std::size_t>(last - first);
  return count > kMostSides ? std::span<const HoleSide>() : std::span(first, count);
}

/// For each component how far its farthest vertex is from the mean of all.
std::vector<double> radii(const TriMesh& mesh, const Components& components) {
  std::vector<Vec3> centres(components.count, Vec3::Zero());
  std::vector<double> counts(components.count, 0.0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    centres[components.of_vertex[v]] += mesh.positions[v];
    counts[components.of_vertex[v]] += 1.0;
  }
  std::vector<double> farthest(components.count, 0.0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t c = components.of_vertex[v];
    farthest[c] = std::max(farthest[c], (mesh.positions[v] - centres[c] / counts[c]).norm());
  }
  return farthest;
}

/// Triangles between three sides, but not the backs of faces. Each side bounds one at most.
std::vector<Triangle> triangles_between(std::span<const HoleSide> sides) {
  std::vector<Triangle> triangles;
  std::vector<bool> is_taken(sides.size(), false);
  const auto index = [&](const HoleSide& side) {
    return static_cast<std::size_t>(&side - sides.data());
  };
  const auto close = [&](const HoleSide& first, const HoleSide& second, const HoleSide& third) {
    const bool are_free =
        !is_taken[index(first)] && !is_taken[index(second)] && !is_taken[index(third)];
    if (are_free && third.to == first.from && first.face != second.face) {
      triangles.push_back({first.from, first.to, second.to});
      is_taken[index(first)] = is_taken[index(second)] = is_taken[index(third)] = true;
    }
  };
  for (const HoleSide& first : sides) {
    for (const HoleSide& second : few_sides_from(sides, first.to)) {
      for (const HoleSide& third : few_sides_from(sides, second.to)) {
        close(first, second, third);
      }
    }
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> missing_triangles(const TriMesh& mesh) {
  std::vector<Triangle> triangles = triangles_between(hole_sides(mesh, build_edge_table(mesh)));
  if (!triangles.empty()) {
    const Components components = connected_components(mesh);
    const std::vector<double> sizes = radii(mesh, components);
    std::erase_if(triangles, [&](const Triangle& t) {
      return longest_edge(mesh, t) > kLongestEdge * sizes[components.of_vertex[t[0]]];
    });
  }
  return triangles;
}

}  // namespace vantage
