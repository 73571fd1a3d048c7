// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "vantage/skeleton/skeleton.h"

#include "core/sizes.h"
#include "skeleton/routing.h"
#include "spatial/graph_distance.h"
#include "spatial/shell.h"

namespace vantage {
namespace {

/// Vertices looked for from the graph [ours]: the share's standard error is then below 1.2 %.
constexpr std::size_t kSightSamples = 2000;
/// Places on the graph that look for a vertex, the nearest first [ours]. Any place would do; more
/// only make the answer slower and never smaller.
constexpr std::size_t kViewers = 64;
constexpr std::size_t kCheckEvery = 4096;  // vertices between two looks at the stop request
/// A vertex is looked for this share of the way before it: it lies on the surface itself.
constexpr double kBefore = 1e-6;

/// For each node the mean thickness of the wall at its vertices; infinite where none is found.
std::vector<double> wall_thickness(const TriMesh& mesh, const Shell& shell,
                                   const Skeleton& skeleton) {
  std::vector<double> sum(skeleton.graph.nodes.size(), 0.0);
  std::vector<double> count(sum.size(), 0.0);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t node = skeleton.node_of_vertex[v];
    if (node == Skeleton::kNone) {
      continue;
    }
    if (const std::optional<Vec3> wall = shell.wall_at(v)) {
      sum[node] += wall->norm();
      count[node] += 1.0;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = count[i] > 0.0 ? sum[i] / count[i] : std::numeric_limits<double>::infinity();
  }
  return sum;
}

void measure_edges(const Shell& shell, const CurveGraph& graph,
                   const std::vector<std::uint32_t>& component, const std::vector<double>& wall,
                   double thin, SkeletonQuality& quality) {
  for (const auto& [a, b] : graph.edges) {
    if (component[a] == Skeleton::kNone || shell.is_open(component[a])) {
      continue;
    }
    quality.length += (graph.nodes[a] - graph.nodes[b]).norm();
    const double outside = shell.outside_length(component[a], graph.nodes[a], graph.nodes[b]);
    quality.outside_length += outside;
    quality.thin_outside += std::min(wall[a], wall[b]) < thin ? outside : 0.0;
  }
}

void measure_distances(const TriMesh& mesh, const Skeleton& skeleton, const RunContext& run,
                       SkeletonQuality& quality) {
  const GraphDistance distance_to(skeleton.graph);
  std::vector<double> nearest(skeleton.graph.nodes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (v % kCheckEvery == 0) {
      run.check();
    }
    const std::uint32_t node = skeleton.node_of_vertex[v];
    if (node == Skeleton::kNone) {
      continue;
    }
    const double distance = distance_to(mesh.positions[v]);
    quality.farthest = std::max(quality.farthest, distance);
    if (skeleton.radius[node] > 0.0) {
      quality.farthest_ratio = std::max(quality.farthest_ratio, distance / skeleton.radius[node]);
    }
    nearest[node] =
        std::min(nearest[node], (mesh.positions[v] - skeleton.graph.nodes[node]).norm());
  }
  double count = 0.0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (skeleton.radius[i] > 0.0 && nearest[i] < std::numeric_limits<double>::infinity()) {
      quality.off_centre += 1.0 - nearest[i] / skeleton.radius[i];
      count += 1.0;
    }
  }
  quality.off_centre /= std::max(count, 1.0);
}

/// Nodes and middles of edges of one component, from which to look.
std::vector<Vec3> viewers_of(const CurveGraph& graph, const std::vector<std::uint32_t>& component,
                             std::uint32_t wanted) {
  std::vector<Vec3> viewers;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (component[i] == wanted) {
      viewers.push_back(graph.nodes[i]);
    }
  }
  for (const auto& [a, b] : graph.edges) {
    if (component[a] == wanted) {
      viewers.push_back(0.5 * (graph.nodes[a] + graph.nodes[b]));
    }
  }
  return viewers;
}

bool is_seen(const Shell& shell, std::uint32_t component, const Vec3& point,
             std::vector<Vec3>& viewers) {
  const std::size_t count = std::min(kViewers, viewers.size());
  std::partial_sort(viewers.begin(), viewers.begin() + static_cast<std::ptrdiff_t>(count),
                    viewers.end(), [&](const Vec3& p, const Vec3& q) {
                      return (p - point).squaredNorm() < (q - point).squaredNorm();
                    });
  return std::any_of(viewers.begin(), viewers.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Vec3& viewer) {
                       return shell.inside(component, viewer, point + kBefore * (viewer - point));
                     });
}

void measure_sight(const TriMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
                   const Shell& shell, const Skeleton& skeleton,
                   const std::vector<std::uint32_t>& component_of_node, const RunContext& run,
                   SkeletonQuality& quality) {
  const std::size_t stride = std::max<std::size_t>(1, mesh.positions.size() / kSightSamples);
  std::vector<Vec3> viewers;
  std::uint32_t component = Skeleton::kNone;
  double seen = 0.0;
  double looked_for = 0.0;
  for (std::size_t v = 0; v < mesh.positions.size(); v += stride) {
    run.check();
    if (skeleton.node_of_vertex[v] == Skeleton::kNone || shell.is_open(component_of_vertex[v])) {
      continue;
    }
    if (component != component_of_vertex[v]) {
      component = component_of_vertex[v];
      viewers = viewers_of(skeleton.graph, component_of_node, component);
    }
    looked_for += 1.0;
    seen += is_seen(shell, component, mesh.positions[v], viewers) ? 1.0 : 0.0;
  }
  quality.seen_fraction = looked_for > 0.0 ? seen / looked_for : 1.0;
}

}  // namespace

SkeletonQuality measure_skeleton(const TriMesh& mesh,
                                 std::span<const std::uint32_t> component_of_vertex,
                                 const Skeleton& skeleton, double thin, const RunContext& run) {
  require_count(component_of_vertex.size(), "labels of components", mesh.positions.size(),
                "vertices");
  SkeletonQuality quality;
  const CurveGraph& graph = skeleton.graph;
  if (graph.nodes.empty()) {
    return quality;
  }
  const Shell shell(mesh, component_of_vertex);
  const std::vector<std::uint32_t> component =
      components_of_nodes(graph, skeleton.node_of_vertex, component_of_vertex);
  measure_edges(shell, graph, component, wall_thickness(mesh, shell, skeleton), thin, quality);
  const std::vector<std::uint32_t> degree = node_degrees(graph);
  quality.ends = static_cast<std::size_t>(std::count(degree.begin(), degree.end(), 1U));
  measure_distances(mesh, skeleton, run, quality);
  measure_sight(mesh, component_of_vertex, shell, skeleton, component, run, quality);
  return quality;
}

}  // namespace vantage
