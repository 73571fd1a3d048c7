// SPDX-License-Identifier: MIT
#include "vantage/skeleton/skeleton.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "vantage/mesh/measures.h"

#include "core/counted.h"
#include "core/parallel.h"
#include "mesh/close_nodes.h"
#include "mesh/extent.h"
#include "skeleton/bent_ends.h"
#include "skeleton/collapsed.h"
#include "skeleton/curve_fitting.h"
#include "skeleton/embedding.h"
#include "skeleton/routing.h"
#include "skeleton/surface_collapse.h"
#include "skeleton/surgery.h"
#include "spatial/shell.h"

namespace vantage {
namespace {

/// Pieces of the curve that the map measures to, relative to the spacing [ours: trials in docs/lab].
constexpr double kPiece = 0.5;

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
  if (options.prune && routing && options.centre) {
    skeleton.graph =
        take_in_bent_ends(skeleton.graph, options.prune_ratio, *routing, skeleton.node_of_vertex);
  }
  if (options.prune) {
    const std::vector<double> radius = node_radii(skeleton.graph, mesh, skeleton.node_of_vertex);
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
    skeleton.warnings.push_back("the skeleton may have lost " + counted(collapsed.lost_handles,
                                                                        "handle", "handles",
                                                                        " of the surface"));
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
  Collapsed collapsed = collapse_thinnest(second.mesh, history, spacing, run);
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
    collapsed = collapse_thinnest(mesh, history, spacing, run.part(0.0, 0.9));
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
  check_coordinates(mesh);
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
