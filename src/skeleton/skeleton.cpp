// SPDX-License-Identifier: MIT
#include "vantage/skeleton/skeleton.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "vantage/mesh/measures.h"

#include "core/parallel.h"
#include "mesh/close_nodes.h"
#include "mesh/decimation.h"
#include "skeleton/cluster_complex.h"
#include "skeleton/collapsed.h"
#include "skeleton/curve_fitting.h"
#include "skeleton/embedding.h"
#include "skeleton/routing.h"
#include "skeleton/surgery.h"
#include "spatial/shell.h"

namespace vantage {
namespace {

/// Surfaces of this many vertices lose short edges in passes before the ordered collapse [ours].
constexpr std::size_t kMergeFrom = 10'000;
/// Longest edge that goes in passes, relative to the spacing [ours: well below what resampling
/// keeps].
constexpr double kMergedLength = 0.125;
/// Pieces of the curve that the map measures to, relative to the spacing [ours: trials in docs/lab].
constexpr double kPiece = 0.5;

/// Share of each vertex in its cluster: its area, or the mean area where it has none.
std::vector<double> cluster_weights(const TriMesh& mesh) {
  std::vector<double> weights = vertex_areas(mesh);
  double mean = 0.0;
  for (const double w : weights) {
    mean += w / static_cast<double>(weights.size());
  }
  for (double& w : weights) {
    w = w > 0.0 ? w : std::max(mean, 1e-300);
  }
  return weights;
}

/// Moves each node to the weighted mean of its vertices; one that only refinement made, and that
/// stands for no vertex, to the mean of its neighbours.
void place_nodes(CurveGraph& graph, const std::vector<Vec3>& positions,
                 const std::vector<double>& weights,
                 const std::vector<std::uint32_t>& node_of_vertex) {
  std::vector<Vec3> sum(graph.nodes.size(), Vec3::Zero());
  std::vector<double> total(graph.nodes.size(), 0.0);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    sum[node_of_vertex[v]] += weights[v] * positions[v];
    total[node_of_vertex[v]] += weights[v];
  }
  std::vector<Vec3> around(graph.nodes.size(), Vec3::Zero());
  std::vector<double> neighbours(graph.nodes.size(), 0.0);
  for (const auto& [a, b] : graph.edges) {
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}}) {
      if (total[from] > 0.0) {
        around[to] += sum[from] / total[from];
        neighbours[to] += 1.0;
      }
    }
  }
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (total[i] > 0.0) {
      graph.nodes[i] = sum[i] / total[i];
    } else if (neighbours[i] > 0.0) {
      graph.nodes[i] = around[i] / neighbours[i];
    }
  }
}

/// Sums of the weights of the vertices that are part of each of `count` nodes, or merged vertices.
std::vector<double> sums_of_parts(const std::vector<double>& weights,
                                  const std::vector<std::uint32_t>& part_of, std::size_t count) {
  std::vector<double> sums(count, 0.0);
  for (std::size_t v = 0; v < weights.size(); ++v) {
    if (part_of[v] != Skeleton::kNone) {
      sums[part_of[v]] += weights[v];
    }
  }
  return sums;
}

/// Nodes of the vertices that were merged, from those of what they were merged in.
std::vector<std::uint32_t> nodes_of_merged(const std::vector<std::uint32_t>& of_vertex,
                                           const std::vector<std::uint32_t>& node_of_merged) {
  std::vector<std::uint32_t> nodes;
  nodes.reserve(of_vertex.size());
  for (const std::uint32_t v : of_vertex) {
    nodes.push_back(node_of_merged[v]);
  }
  return nodes;
}

/// Collapses the edges of a contracted surface until a graph is left.
class SurfaceCollapse {
 public:
  SurfaceCollapse(const TriMesh& mesh, const ContractionHistory& history, double spacing)
      : mesh_(mesh),
        history_(history),
        merged_length_(kMergedLength * spacing),
        weights_(cluster_weights(mesh)) {}

  /// Where the surface is thinnest. Where several handles have shrunk into one another there, the
  /// order of collapses is taken from the last level at which no handle is lost; nodes stand at the
  /// mean of their vertices' thinnest positions all the same.
  Collapsed thinnest(const RunContext& run) const {
    Collapsed best = at(history_.thinnest(), run.part(0.0, 0.5));
    double share = 0.5;
    const std::size_t before = history_.levels.size() - (history_.thinned.empty() ? 1 : 0);
    for (std::size_t level = before; level-- > 0 && best.lost_handles > 0;) {
      Collapsed trial = at(history_.levels[level], run.part(share, 0.5 * (1.0 + share)));
      share = 0.5 * (1.0 + share);
      if (trial.lost_handles < best.lost_handles) {
        best = std::move(trial);
      }
    }
    place_nodes(best.graph, history_.thinnest(), weights_, best.node_of_vertex);
    return best;
  }

 private:
  /// With the vertices at `positions`; each merged one at the mean of what was merged in it.
  [[nodiscard]] Collapsed at(const std::vector<Vec3>& positions, const RunContext& run) const {
    if (!history_.merged) {
      return collapse(mesh_.triangles, positions, weights_, run);
    }
    const MergedSurface& merged = *history_.merged;
    const std::vector<double> sums = sums_of_parts(weights_, merged.of_vertex, merged.vertex_count);
    std::vector<Vec3> means(merged.vertex_count, Vec3::Zero());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const std::uint32_t to = merged.of_vertex[v];
      means[to] += (weights_[v] / sums[to]) * positions[v];
    }
    Collapsed collapsed = collapse(merged.triangles, means, sums, run);
    collapsed.node_of_vertex = nodes_of_merged(merged.of_vertex, collapsed.node_of_vertex);
    return collapsed;
  }

  /// Large surfaces lose their shortest edges first, in passes; the graph is as fine as before,
  /// because spacing is much longer than they are.
  [[nodiscard]] Collapsed collapse(const std::vector<Triangle>& triangles,
                                   const std::vector<Vec3>& positions,
                                   const std::vector<double>& weights,
                                   const RunContext& run) const {
    const TriMesh mesh{positions, triangles};
    Collapsed collapsed;
    if (positions.size() < kMergeFrom) {
      ClusterComplex complex(mesh, positions, weights);
      collapsed.lost_handles = collapse_to_graph(complex, run);
      collapsed.graph = complex.graph(collapsed.node_of_vertex);
      return collapsed;
    }
    const Decimation merged = merge_short_edges(mesh, weights, merged_length_, run);
    ClusterComplex complex(merged.mesh, merged.mesh.positions,
                           sums_of_parts(weights, merged.of_vertex, merged.mesh.positions.size()));
    collapsed.lost_handles = collapse_to_graph(complex, run);
    std::vector<std::uint32_t> node_of_merged;
    collapsed.graph = complex.graph(node_of_merged);
    collapsed.node_of_vertex = nodes_of_merged(merged.of_vertex, node_of_merged);
    return collapsed;
  }

  const TriMesh& mesh_;
  const ContractionHistory& history_;
  double merged_length_;
  std::vector<double> weights_;
};

/// Whether every level, and the table of components, has an entry for each vertex.
bool belongs_to(const ContractionHistory& history, const TriMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  return !history.levels.empty() && history.component_of_vertex.size() == n &&
         (history.thinned.empty() || history.thinned.size() == n) &&
         std::all_of(history.levels.begin(), history.levels.end(),
                     [n](const auto& level) { return level.size() == n; });
}

/// Leaves out the nodes that stand for vertices without faces.
CurveGraph without_isolated(const CurveGraph& graph, const ContractionHistory& history,
                            std::vector<std::uint32_t>& node_of_vertex) {
  std::vector<bool> wanted(graph.nodes.size(), true);
  for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
    if (history.component_of_vertex[v] == ContractionHistory::kIsolated) {
      wanted[node_of_vertex[v]] = false;
    }
  }
  CurveGraph kept;
  std::vector<std::uint32_t> new_of_old(graph.nodes.size(), Skeleton::kNone);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (wanted[i]) {
      new_of_old[i] = static_cast<std::uint32_t>(kept.nodes.size());
      kept.nodes.push_back(graph.nodes[i]);
    }
  }
  for (const auto& [a, b] : graph.edges) {
    kept.edges.push_back({new_of_old[a], new_of_old[b]});
  }
  for (std::uint32_t& node : node_of_vertex) {
    node = new_of_old[node];
  }
  return kept;
}

/// What of the graph's length in closed components is outside their shells.
double outside_share(const CurveGraph& graph, const Routing& routing,
                     const std::vector<std::uint32_t>& node_of_vertex) {
  const std::vector<std::uint32_t> component =
      components_of_nodes(graph, node_of_vertex, routing.component_of_vertex);
  double length = 0.0;
  double outside = 0.0;
  for (const auto& [a, b] : graph.edges) {
    if (component[a] != Skeleton::kNone && !routing.shell.is_open(component[a])) {
      length += (graph.nodes[a] - graph.nodes[b]).norm();
      outside += routing.shell.outside_length(component[a], graph.nodes[a], graph.nodes[b]);
    }
  }
  return length > 0.0 ? outside / length : 0.0;
}

/// From the raw graph to the finished one.
void finish(const TriMesh& mesh, const ContractionHistory& history, const Shell* shell,
            const SkeletonOptions& options, const RunContext& run, Skeleton& skeleton) {
  skeleton.graph = skeleton.raw;
  skeleton.node_of_vertex = skeleton.raw_node_of_vertex;
  std::optional<Routing> routing;
  if (shell) {
    routing.emplace(Routing{mesh, history.component_of_vertex, *shell, run});
  }
  if (routing && options.centre) {
    skeleton.graph = centre_nodes(skeleton.graph, mesh, skeleton.node_of_vertex);
    skeleton.graph =
        move_nodes_inside(skeleton.graph, skeleton.raw, *routing, skeleton.node_of_vertex);
  }
  if (options.prune) {
    std::vector<double> radius = node_radii(skeleton.graph, mesh, skeleton.node_of_vertex);
    skeleton.graph =
        prune_ends(skeleton.graph, options.prune_ratio, radius, skeleton.node_of_vertex);
  }
  if (routing && options.centre) {
    skeleton.graph = route_edges_inside(skeleton.graph, *routing, skeleton.node_of_vertex);
  }
  if (routing) {
    skeleton.outside_share = outside_share(skeleton.graph, *routing, skeleton.node_of_vertex);
  }
  skeleton.radius = node_radii(skeleton.graph, mesh, skeleton.node_of_vertex);
}

/// Leads a raw graph through the contracted surface.
CurveGraph fitted(const CurveGraph& raw, const TriMesh& mesh, const ContractionHistory& history,
                  const std::vector<std::uint32_t>& node_of_vertex,
                  const SkeletonOptions& options) {
  return fit_curve(raw, history.thinnest(), cluster_weights(mesh), node_of_vertex,
                   kPiece * sample_spacing(mesh, options));
}

/// The graph with nodes that are `spacing` apart, each at the mean of what it stands for.
CurveGraph resampled(const CurveGraph& fine, const TriMesh& mesh, double spacing,
                     std::vector<std::uint32_t>& node_of_vertex) {
  return merge_close_nodes(fine, spacing,
                           sums_of_parts(cluster_weights(mesh), node_of_vertex, fine.nodes.size()),
                           node_of_vertex);
}

/// Resamples a collapsed graph, which gives the raw one; the finished one stays empty.
Skeleton raw_skeleton(const TriMesh& mesh, const ContractionHistory& history, Collapsed collapsed,
                      const SkeletonOptions& options) {
  Skeleton skeleton;
  if (collapsed.lost_handles > 0) {
    skeleton.warnings.push_back("the skeleton may have lost " +
                                std::to_string(collapsed.lost_handles) +
                                " handle(s) of the surface");
  }
  skeleton.raw_node_of_vertex = std::move(collapsed.node_of_vertex);
  const CurveGraph fine = without_isolated(collapsed.graph, history, skeleton.raw_node_of_vertex);
  skeleton.raw = resampled(fine, mesh, sample_spacing(mesh, options), skeleton.raw_node_of_vertex);
  skeleton.curve = skeleton.raw;
  return skeleton;
}

/// What fitted() makes of the surface meshed anew: another curve as good as that.
CurveGraph curve_of(const SecondMesh& second, const SkeletonOptions& options,
                    const RunContext& run) {
  ContractionHistory history;
  history.levels = second.levels;
  history.component_of_vertex = second.component_of_vertex;
  const double spacing = sample_spacing(second.mesh, options);
  Collapsed collapsed = SurfaceCollapse(second.mesh, history, spacing).thinnest(run);
  const CurveGraph raw = resampled(collapsed.graph, second.mesh, spacing, collapsed.node_of_vertex);
  return fitted(raw, second.mesh, history, collapsed.node_of_vertex, options);
}

}  // namespace

double sample_spacing(const TriMesh& mesh, const SkeletonOptions& options) {
  const std::vector<Vec3> points = referenced_points(mesh);
  return options.spacing * (options.scaling == ContractionScaling::Box
                                ? bounding_box(points).size().norm()
                                : enclosing_sphere(points).diameter);
}

std::unique_ptr<const Shell> shell_to_finish(const TriMesh& mesh,
                                             const ContractionHistory& history) {
  return mesh.triangles.empty() ? nullptr
                                : std::make_unique<Shell>(mesh, history.component_of_vertex);
}

Skeleton finish_skeleton(const TriMesh& mesh, const ContractionHistory& history,
                         Collapsed collapsed, const Shell* shell, const SkeletonOptions& options,
                         const RunContext& run) {
  Skeleton skeleton = raw_skeleton(mesh, history, std::move(collapsed), options);
  finish(mesh, history, shell, options, run, skeleton);
  return skeleton;
}

namespace {

/// How much of a skeleton is made: all, or what the map measures to.
enum class Extent { Finished, OfTheMap };

/// The skeleton of a surface that was contracted as it is.
Skeleton skeleton_of(const TriMesh& mesh, const ContractionHistory& history,
                     const SkeletonOptions& options, Extent extent, const RunContext& run) {
  const double spacing = sample_spacing(mesh, options);
  Collapsed collapsed;
  const auto collapse = [&] {
    collapsed = SurfaceCollapse(mesh, history, spacing).thinnest(run.part(0.0, 0.9));
  };
  Skeleton skeleton;
  if (extent == Extent::OfTheMap) {
    collapse();
    skeleton = raw_skeleton(mesh, history, std::move(collapsed), options);
  } else {
    // The collapse, from one edge to the next, leaves the other cores idle.
    std::unique_ptr<const Shell> shell;
    run_both(run, collapse, [&] { shell = shell_to_finish(mesh, history); });
    skeleton = finish_skeleton(mesh, history, std::move(collapsed), shell.get(), options, run);
  }
  if (options.fit) {
    skeleton.curve = fitted(skeleton.raw, mesh, history, skeleton.raw_node_of_vertex, options);
  }
  return skeleton;
}

/// \param whole the history of `mesh`, with that of the finer surface that was contracted. \return its
/// skeleton, with what its first vertices belong to.
Skeleton of_refinement(const TriMesh& mesh, const ContractionHistory& whole,
                       const SkeletonOptions& options, Extent extent, const RunContext& run) {
  const ContractedRefinement& refinement = *whole.refinement;
  ContractionHistory history;
  history.levels = refinement.levels;
  history.component_of_vertex = refinement.component_of_vertex;
  history.thinned = refinement.thinned;
  history.merged = whole.merged;
  Skeleton skeleton = skeleton_of(refinement.mesh, history, options, extent, run);
  if (extent == Extent::Finished) {
    skeleton.node_of_vertex.resize(mesh.positions.size());
  }
  skeleton.raw_node_of_vertex.resize(mesh.positions.size());
  return skeleton;
}

Skeleton extract(const TriMesh& mesh, const ContractionHistory& history,
                 const SkeletonOptions& options, Extent extent, const RunContext& run) {
  check_fields(options, kSkeletonFields);
  if (!belongs_to(history, mesh)) {
    throw InvalidInput("the contraction history does not belong to this mesh");
  }
  const RunContext most = run.part(0.0, 0.9);
  Skeleton skeleton = history.refinement ? of_refinement(mesh, history, options, extent, most)
                                         : skeleton_of(mesh, history, options, extent, most);
  if (options.fit && !history.second.levels.empty()) {
    skeleton.other_curve = curve_of(history.second, options, run.part(0.9, 1.0));
  }
  run.advance("skeleton", 1.0);
  return skeleton;
}

}  // namespace

Skeleton extract_skeleton(const TriMesh& mesh, const ContractionHistory& history,
                          const SkeletonOptions& options, const RunContext& run) {
  return extract(mesh, history, options, Extent::Finished, run);
}

Skeleton extract_curve(const TriMesh& mesh, const ContractionHistory& history,
                       const SkeletonOptions& options, const RunContext& run) {
  return extract(mesh, history, options, Extent::OfTheMap, run);
}

}  // namespace vantage
