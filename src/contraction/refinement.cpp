// SPDX-License-Identifier: MIT
#include "contraction/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/edge_splitting.h"

namespace vantage {
namespace {

/// A face is coarse if an edge of it is longer than this, over the component's diameter [ours: two
/// skeleton samples].
constexpr double kCoarse = 0.04;
/// A component is refined if coarse faces hold more than this share of its area [ours].
constexpr double kCoarseShare = 0.5;
/// Edges are split down to this length, over the component's diameter [ours: trials in docs/lab].
constexpr double kFineEdge = 0.03;
/// Vertices that refinement may make of a component, about [ours]; its edges stay longer where that
/// is not enough.
constexpr double kMostVertices = 20'000.0;
constexpr double kCoarser = 1.25;  // factor on the edge length while that is exceeded
/// Vertices that it may make of all components, about [ours]: the largest come first, and those for
/// which no vertices are left stay as they are.
constexpr double kMostOfAll = 60'000.0;

constexpr double kNoBound = std::numeric_limits<double>::infinity();  // an edge length of no bound

double longest_edge(const TriMesh& mesh, const Triangle& t) {
  const auto& x = mesh.positions;
  return std::max(
      {(x[t[0]] - x[t[1]]).norm(), (x[t[1]] - x[t[2]]).norm(), (x[t[2]] - x[t[0]]).norm()});
}

/// A component's faces, and how large it is.
struct CoarsePart {
  std::vector<std::uint32_t> faces{};
  double diameter = 0.0;
  double area = 0.0;
  double edge = kNoBound;  ///< Down to which its edges are to be split.
  double vertices = 0.0;   ///< That this makes, about.
};

std::vector<CoarsePart> parts_of(const TriMesh& mesh) {
  const Components components = connected_components(mesh);
  std::vector<CoarsePart> parts(components.count);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    parts[components.of_vertex[mesh.triangles[f][0]]].faces.push_back(f);
  }
  for (CoarsePart& part : parts) {
    std::vector<Vec3> corners;
    for (const std::uint32_t f : part.faces) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        corners.push_back(mesh.positions[v]);
      }
      part.area += 0.5 * area_vector(mesh, mesh.triangles[f]).norm();
    }
    part.diameter = corners.empty() ? 0.0 : enclosing_sphere(corners).diameter;
  }
  return parts;
}

bool is_coarse(const TriMesh& mesh, const CoarsePart& part) {
  double coarse = 0.0;
  for (const std::uint32_t f : part.faces) {
    if (longest_edge(mesh, mesh.triangles[f]) > kCoarse * part.diameter) {
      coarse += 0.5 * area_vector(mesh, mesh.triangles[f]).norm();
    }
  }
  return coarse > kCoarseShare * part.area;
}

/// About the number of vertices that splitting the part down to `edge` makes: those of its area, and
/// those along its sides, which long thin faces have more of.
double estimated_vertices(const TriMesh& mesh, const CoarsePart& part, double edge) {
  double count = 4.0 * part.area / (edge * edge);
  for (const std::uint32_t f : part.faces) {
    count += 2.0 * longest_edge(mesh, mesh.triangles[f]) / edge;
  }
  return count;
}

/// Chooses the length down to which the part's edges are split.
void choose_edge(const TriMesh& mesh, CoarsePart& part) {
  part.edge = kFineEdge * part.diameter;
  part.vertices = estimated_vertices(mesh, part, part.edge);
  while (part.edge < part.diameter && part.vertices > kMostVertices) {
    part.edge *= kCoarser;
    part.vertices = estimated_vertices(mesh, part, part.edge);
  }
}

/// Parts in the order in which they may be refined: the largest first; those whose areas differ by
/// rounding only in the order of the file.
std::vector<std::size_t> largest_first(const std::vector<CoarsePart>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return static_cast<float>(parts[a].area) > static_cast<float>(parts[b].area);
  });
  return order;
}

/// The mesh around the origin, of diameter 1: areas of very large or small models have no double.
TriMesh unit_size(const TriMesh& mesh, const Sphere& sphere) {
  TriMesh unit = mesh;
  for (Vec3& p : unit.positions) {
    p = (p - sphere.centre) / sphere.diameter;
  }
  return unit;
}

}  // namespace

std::optional<TriMesh> refine_coarse_components(const TriMesh& mesh, const RunContext& run) {
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  if (mesh.triangles.empty() || !(sphere.diameter > 0.0)) {
    return std::nullopt;
  }
  const TriMesh unit = unit_size(mesh, sphere);
  std::vector<CoarsePart> parts = parts_of(unit);
  std::vector<double> longest(mesh.triangles.size(), kNoBound);
  double vertices = 0.0;
  for (const std::size_t p : largest_first(parts)) {
    CoarsePart& part = parts[p];
    if (!is_coarse(unit, part)) {
      continue;
    }
    choose_edge(unit, part);
    if (vertices + part.vertices <= kMostOfAll) {
      vertices += part.vertices;
      for (const std::uint32_t f : part.faces) {
        longest[f] = part.edge * sphere.diameter;
      }
    }
  }
  return vertices > 0.0 ? std::optional(split_long_edges(mesh, std::move(longest), run))
                        : std::nullopt;
}

TriMesh refine_whole(const TriMesh& scaled, const RunContext& run) {
  std::vector<CoarsePart> parts = parts_of(scaled);
  std::vector<double> longest(scaled.triangles.size(), kNoBound);
  for (CoarsePart& part : parts) {
    choose_edge(scaled, part);
    for (const std::uint32_t f : part.faces) {
      longest[f] = part.edge;
    }
  }
  return split_long_edges(scaled, std::move(longest), run);
}

}  // namespace vantage
