// SPDX-License-Identifier: MIT
#include "skeleton/surface_collapse.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "mesh/decimation.h"
#include "mesh/pieces.h"
#include "skeleton/cluster_complex.h"
#include "skeleton/surgery.h"

namespace vantage {
namespace {

/// Surfaces of this many vertices lose short edges in passes before the ordered collapse [ours].
constexpr std::size_t kMergeFrom = 10'000;
/// Longest edge that goes in passes, relative to the spacing [ours: well below what resampling
/// keeps].
constexpr double kMergedLength = 0.125;

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

/// The nodes of vertices, from those of what they were merged in.
std::vector<std::uint32_t> nodes_of_merged(const std::vector<std::uint32_t>& of_vertex,
                                           const std::vector<std::uint32_t>& node_of_merged) {
  std::vector<std::uint32_t> nodes;
  nodes.reserve(of_vertex.size());
  for (const std::uint32_t v : of_vertex) {
    nodes.push_back(node_of_merged[v]);
  }
  return nodes;
}

/// The vertices that each merged one stands for, ascending.
IndexLists vertices_of_merged(const std::vector<std::uint32_t>& of_vertex, std::size_t count) {
  IndexLists lists{.offsets = std::vector<std::uint32_t>(count + 1, 0),
                   .values = std::vector<std::uint32_t>(of_vertex.size())};
  for (const std::uint32_t to : of_vertex) {
    ++lists.offsets[to + 1];
  }
  std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
  std::vector<std::uint32_t> cursor(lists.offsets.begin(), lists.offsets.end() - 1);
  for (std::uint32_t v = 0; v < of_vertex.size(); ++v) {
    lists.values[cursor[of_vertex[v]]++] = v;
  }
  return lists;
}

/// Handles of a piece for which its graph has no cycle; where they cannot be counted, as of a surface that
/// is not closed, those that the collapse could not keep.
std::size_t lost_handles(const Piece& piece, const Collapsed& part) {
  const std::size_t cycles = cycle_count(part.graph);
  // Euler's formula for a closed surface; one with borders has fewer faces.
  const bool may_have_more = piece.triangles.size() + 4 > 2 * piece.vertices.size() + 4 * cycles;
  if (part.lost_handles == 0 && !may_have_more) {
    return 0;
  }
  const std::optional<std::size_t> genus =
      check_mesh({std::vector<Vec3>(piece.vertices.size(), Vec3::Zero()), piece.triangles}).genus;
  return genus ? *genus - std::min(*genus, cycles) : part.lost_handles;
}

/// What is collapsed: the surface, or what contraction merged it to.
class SurfaceCollapse {
 public:
  SurfaceCollapse(const TriMesh& mesh, const ContractionHistory& history, double spacing)
      : history_(history),
        merged_length_(kMergedLength * spacing),
        weights_(cluster_weights(mesh)),
        of_vertex_(mesh.positions.size()) {
    const auto& merged = history.merged;
    const TriMesh surface =
        merged ? TriMesh{std::vector<Vec3>(merged->vertex_count), merged->triangles} : mesh;
    if (merged) {
      of_vertex_ = merged->of_vertex;
    } else {
      std::iota(of_vertex_.begin(), of_vertex_.end(), 0U);
    }
    count_ = surface.positions.size();
    stands_for_ = vertices_of_merged(of_vertex_, count_);
    sums_ = sums_of_parts(weights_, of_vertex_, count_);
    pieces_ = cut_into_pieces(surface);
  }

  [[nodiscard]] Collapsed thinnest(const RunContext& run) const {
    std::vector<Collapsed> parts(pieces_.all.size());
    std::vector<std::size_t> sizes;
    for (const Piece& piece : pieces_.all) {
      sizes.push_back(piece.vertices.size());
    }
    parallel_items(run, "skeleton", sizes, [&](std::size_t i, const RunContext& own) {
      parts[i] = thinnest(pieces_.all[i], own);
    });
    Collapsed whole = joined(parts);
    whole.node_of_vertex = nodes_of_merged(of_vertex_, whole.node_of_vertex);
    place_nodes(whole.graph, history_.thinnest(), weights_, whole.node_of_vertex);
    return whole;
  }

 private:
  /// Of a piece where it is thinnest, or by another level if that loses fewer handles.
  [[nodiscard]] Collapsed thinnest(const Piece& piece, const RunContext& run) const {
    std::vector<Vec3> tried = positions(piece, history_.thinnest());
    Collapsed best = collapse(piece, tried, run.part(0.0, 0.5));
    double share = 0.5;
    for (std::size_t level = history_.levels.size(); level-- > 0 && best.lost_handles > 0;) {
      std::vector<Vec3> here = positions(piece, history_.levels[level]);
      if (here == tried) {
        continue;  // the piece had stopped before
      }
      Collapsed trial =
          collapse(piece, here, run.part(share, 0.5 * (1.0 + share)), best.lost_handles);
      share = 0.5 * (1.0 + share);
      if (trial.lost_handles < best.lost_handles) {
        best = std::move(trial);
      }
      tried = std::move(here);
    }
    return best;
  }

  /// Each vertex of the piece at the mean of what was merged in it.
  [[nodiscard]] std::vector<Vec3> positions(const Piece& piece,
                                            const std::vector<Vec3>& level) const {
    std::vector<Vec3> means;
    means.reserve(piece.vertices.size());
    for (const std::uint32_t to : piece.vertices) {
      Vec3 mean = Vec3::Zero();
      for (const std::uint32_t v : stands_for_[to]) {
        mean += (weights_[v] / sums_[to]) * level[v];
      }
      means.push_back(mean);
    }
    return means;
  }

  /// Large surfaces lose their shortest edges first, in passes; the graph is as fine as before,
  /// because spacing is much longer than they are.
  [[nodiscard]] Collapsed collapse(const Piece& piece, const std::vector<Vec3>& positions,
                                   const RunContext& run,
                                   std::size_t given_up_at = kNeverGivenUp) const {
    std::vector<double> weights;
    weights.reserve(piece.vertices.size());
    for (const std::uint32_t v : piece.vertices) {
      weights.push_back(sums_[v]);
    }
    const TriMesh mesh{positions, piece.triangles};
    if (count_ < kMergeFrom) {
      return collapse(mesh, weights, run, given_up_at);
    }
    const Decimation merged = merge_short_edges(mesh, weights, merged_length_, run);
    Collapsed collapsed = collapse(
        merged.mesh, sums_of_parts(weights, merged.of_vertex, merged.mesh.positions.size()), run,
        given_up_at);
    collapsed.node_of_vertex = nodes_of_merged(merged.of_vertex, collapsed.node_of_vertex);
    return collapsed;
  }

  [[nodiscard]] static Collapsed collapse(const TriMesh& mesh, const std::vector<double>& weights,
                                          const RunContext& run, std::size_t given_up_at) {
    ClusterComplex complex(mesh, mesh.positions, weights);
    Collapsed collapsed;
    collapsed.lost_handles = collapse_to_graph(complex, run, given_up_at);
    ClusterGraph made = complex.graph();
    collapsed.graph = std::move(made.graph);
    collapsed.node_of_vertex = std::move(made.node_of_vertex);
    return collapsed;
  }

  /// One graph of all pieces. Nodes are in the order of their first vertices, those that stand for none
  /// come last.
  [[nodiscard]] Collapsed joined(const std::vector<Collapsed>& parts) const {
    Collapsed whole;
    std::vector<std::vector<std::uint32_t>> nodes;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      nodes.emplace_back(parts[p].graph.nodes.size(), Skeleton::kNone);
      whole.lost_handles += lost_handles(pieces_.all[p], parts[p]);
    }
    const auto add = [&whole](const Vec3& position) {
      whole.graph.nodes.push_back(position);
      return static_cast<std::uint32_t>(whole.graph.nodes.size() - 1);
    };
    for (std::uint32_t v = 0; v < count_; ++v) {
      const std::uint32_t p = pieces_.of_vertex[v];
      if (p == Pieces::kIsolated) {
        whole.node_of_vertex.push_back(add(history_.thinnest()[stands_for_[v][0]]));
        continue;
      }
      const std::uint32_t local = parts[p].node_of_vertex[pieces_.local[v]];
      std::uint32_t& node = nodes[p][local];
      node = node == Skeleton::kNone ? add(parts[p].graph.nodes[local]) : node;
      whole.node_of_vertex.push_back(node);
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (std::size_t i = 0; i < nodes[p].size(); ++i) {
        nodes[p][i] = nodes[p][i] == Skeleton::kNone ? add(parts[p].graph.nodes[i]) : nodes[p][i];
      }
      for (const auto& [a, b] : parts[p].graph.edges) {
        whole.graph.edges.push_back(
            {std::min(nodes[p][a], nodes[p][b]), std::max(nodes[p][a], nodes[p][b])});
      }
    }
    std::sort(whole.graph.edges.begin(), whole.graph.edges.end());
    return whole;
  }

  const ContractionHistory& history_;
  double merged_length_;
  std::vector<double> weights_;           ///< Of each vertex of the mesh.
  std::vector<std::uint32_t> of_vertex_;  ///< What each vertex of the mesh is merged in.
  std::size_t count_ = 0;                 ///< Of merged vertices.
  IndexLists stands_for_{};               ///< What each merged vertex stands for.
  std::vector<double> sums_{};            ///< Weights of merged vertices.
  Pieces pieces_{};                       ///< Of merged vertices.
};

}  // namespace

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

Collapsed collapse_thinnest(const TriMesh& mesh, const ContractionHistory& history, double spacing,
                            const RunContext& run) {
  return SurfaceCollapse(mesh, history, spacing).thinnest(run);
}

}  // namespace vantage
