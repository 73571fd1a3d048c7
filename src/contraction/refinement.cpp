// SPDX-License-Identifier: MIT
#include "contraction/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/edge_splitting.h"

namespace vantage {
namespace {

/// A face is coarse if an edge of it is longer than this, over D [ours: two skeleton samples].
constexpr double kCoarse = 0.04;
/// A component is refined if coarse faces hold more than this share of its area [ours].
constexpr double kCoarseShare = 0.5;
/// Edges are split down to this length, over D [ours: trials in docs/lab].
constexpr double kFineEdge = 0.03;
/// Vertices that refinement may make about, of all components together [ours]; edges stay longer
/// where that is not enough.
constexpr double kMostVertices = 20'000.0;
constexpr double kCoarser = 1.25;  // factor on the edge length while that is exceeded

double longest_edge(const TriMesh& mesh, const Triangle& t) {
  const auto& x = mesh.positions;
  return std::max(
      {(x[t[0]] - x[t[1]]).norm(), (x[t[1]] - x[t[2]]).norm(), (x[t[2]] - x[t[0]]).norm()});
}

/// The faces of the components to refine, one entry per face of a mesh of diameter 1.
std::vector<bool> faces_to_refine(const TriMesh& mesh) {
  const Components components = connected_components(mesh);
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> area(components.count, 0.0);
  std::vector<double> coarse(components.count, 0.0);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const std::uint32_t component = components.of_vertex[mesh.triangles[f][0]];
    area[component] += areas[f];
    if (longest_edge(mesh, mesh.triangles[f]) > kCoarse) {
      coarse[component] += areas[f];
    }
  }
  std::vector<bool> chosen(areas.size(), false);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const std::uint32_t component = components.of_vertex[mesh.triangles[f][0]];
    chosen[f] = coarse[component] > kCoarseShare * area[component];
  }
  return chosen;
}

/// About the number of vertices that splitting the chosen faces down to `edge` makes: those of its
/// area, and those along its sides, which long thin faces have more of.
double estimated_vertices(const TriMesh& mesh, const std::vector<bool>& chosen, double edge) {
  double count = 0.0;
  for (std::size_t f = 0; f < chosen.size(); ++f) {
    if (chosen[f]) {
      const double twice = area_vector(mesh, mesh.triangles[f]).norm();
      count += 2.0 * twice / (edge * edge) + 2.0 * longest_edge(mesh, mesh.triangles[f]) / edge;
    }
  }
  return count;
}

/// The length down to which edges of a mesh of diameter 1 are split.
double affordable_edge(const TriMesh& unit, const std::vector<bool>& chosen) {
  double edge = kFineEdge;
  while (edge < 1.0 && estimated_vertices(unit, chosen, edge) > kMostVertices) {
    edge *= kCoarser;
  }
  return edge;
}

}  // namespace

std::optional<TriMesh> refine_coarse_components(const TriMesh& mesh, const RunContext& run) {
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  if (mesh.triangles.empty() || !(sphere.diameter > 0.0)) {
    return std::nullopt;
  }
  TriMesh unit = mesh;  // areas of very large or small models have no double
  for (Vec3& p : unit.positions) {
    p = (p - sphere.centre) / sphere.diameter;
  }
  std::vector<bool> chosen = faces_to_refine(unit);
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) {
    return std::nullopt;
  }
  const double edge = affordable_edge(unit, chosen);
  return split_long_edges(mesh, std::move(chosen), edge * sphere.diameter, run);
}

TriMesh refine_whole(const TriMesh& scaled, const RunContext& run) {
  TriMesh unit = scaled;
  for (Vec3& p : unit.positions) {
    p *= 0.5;
  }
  std::vector<bool> all(scaled.triangles.size(), true);
  const double edge = 2.0 * affordable_edge(unit, all);
  return split_long_edges(scaled, std::move(all), edge, run);
}

}  // namespace vantage
