// SPDX-License-Identifier: MIT
#include "skeleton/embedding.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/skeleton/skeleton.h"

namespace vantage {
namespace {

/// An end of the graph: the nodes from its tip up to, not including, the junction.
struct End {
  double length = 0.0;
  std::uint32_t junction = Skeleton::kNone;  ///< None on a plain path.
  std::vector<std::uint32_t> nodes{};
};

/// The ends of a graph while they are cut. Each tip walks on from where it stands when its junction becomes
/// a node of its chain, so that no edge is walked twice in one direction.
class Ends {
 public:
  Ends(const CurveGraph& graph, double ratio, const std::vector<double>& radius)
      : graph_(graph),
        ratio_(ratio),
        radius_(radius),
        neighbours_(node_neighbours(graph)),
        degree_(node_degrees(graph)) {
    const std::size_t count = graph.nodes.size();
    stands_for_.resize(count);
    std::iota(stands_for_.begin(), stands_for_.end(), 0U);
    end_at_.assign(count, kNoEnd);
    for (std::uint32_t tip = 0; tip < count; ++tip) {
      if (degree_[tip] == 1) {
        ends_.emplace_back().nodes.push_back(tip);
        walk(ends_.size() - 1);
      }
    }
  }

  /// Cuts all that are shorter than their junction is thick, shortest first. \return of each node the one
  /// that takes its vertices.
  std::vector<std::uint32_t> cut() {
    while (!shorter_.empty()) {
      const Short next = shorter_.top();
      shorter_.pop();
      if (ends_[next.end].junction == next.junction) {  // it has not grown since
        cut(ends_[next.end]);
      }
    }
    return std::move(stands_for_);
  }

 private:
  static constexpr std::size_t kNoEnd = std::numeric_limits<std::size_t>::max();

  struct Short {
    double length;
    std::size_t end;
    std::uint32_t junction;

    /// Order of a min-heap: by length, then by tip.
    bool operator<(const Short& other) const {
      return std::tie(other.length, other.end) < std::tie(length, end);
    }
  };

  /// From the end's last node to the first junction; there is none on a plain path.
  void walk(std::size_t index) {
    End& end = ends_[index];
    end.junction = Skeleton::kNone;
    std::uint32_t node = end.nodes.back();
    std::uint32_t previous =
        end.nodes.size() > 1 ? end.nodes[end.nodes.size() - 2] : Skeleton::kNone;
    for (;;) {
      std::uint32_t next = Skeleton::kNone;
      for (const std::uint32_t c : neighbours_[node]) {
        next = c != previous && stands_for_[c] == c ? c : next;
      }
      if (next == Skeleton::kNone) {
        return;
      }
      end.length += (graph_.nodes[next] - graph_.nodes[node]).norm();
      previous = node;
      node = next;
      if (degree_[node] > 2) {
        break;
      }
      end.nodes.push_back(node);
    }
    end.junction = node;
    end_at_[previous] = index;
    if (end.length < ratio_ * radius_[node]) {
      shorter_.push({end.length, index, node});
    }
  }

  void cut(End& end) {
    const std::uint32_t junction = end.junction;
    for (const std::uint32_t node : end.nodes) {
      stands_for_[node] = junction;
    }
    end = {};
    if (--degree_[junction] > 2) {
      return;
    }
    for (const std::uint32_t last : neighbours_[junction]) {
      const std::size_t waiting = end_at_[last];
      if (stands_for_[last] == last && waiting != kNoEnd && ends_[waiting].junction == junction) {
        ends_[waiting].nodes.push_back(junction);
        walk(waiting);
      }
    }
  }

  const CurveGraph& graph_;
  double ratio_;
  const std::vector<double>& radius_;
  IndexLists neighbours_;
  std::vector<std::uint32_t> degree_;        ///< Of each node: neighbours that are left.
  std::vector<std::uint32_t> stands_for_{};  ///< Of each node; itself if it is left.
  std::vector<std::size_t> end_at_{};        ///< Of each node: the end that it is the last of.
  std::vector<End> ends_{};                  ///< By ascending tip.
  std::priority_queue<Short> shorter_{};     ///< To be cut, unless they have grown since.
};

/// Radii in which nodes that stand for no vertex have the mean of their neighbours, ring by ring.
/// \param count of vertices of each node.
std::vector<double> filled_from_neighbours(const CurveGraph& graph, std::vector<double> count,
                                           std::vector<double> radius) {
  const IndexLists lists = node_neighbours(graph);
  for (bool changed = true; changed;) {
    changed = false;
    const std::vector<double> known = count;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      double sum = 0.0;
      double neighbours = 0.0;
      for (const std::uint32_t c : lists[i]) {
        sum += known[c] > 0.0 ? radius[c] : 0.0;
        neighbours += known[c] > 0.0 ? 1.0 : 0.0;
      }
      if (known[i] == 0.0 && neighbours > 0.0) {
        radius[i] = sum / neighbours;
        count[i] = 1.0;
        changed = true;
      }
    }
  }
  return radius;
}

}  // namespace

std::vector<double> node_radii(const CurveGraph& graph, const TriMesh& mesh,
                               std::span<const std::uint32_t> node_of_vertex) {
  std::vector<double> sum(graph.nodes.size(), 0.0);
  std::vector<double> count(graph.nodes.size(), 0.0);
  for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
    const std::uint32_t node = node_of_vertex[v];
    if (node != Skeleton::kNone) {
      sum[node] += (mesh.positions[v] - graph.nodes[node]).norm();
      count[node] += 1.0;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = count[i] > 0.0 ? sum[i] / count[i] : 0.0;
  }
  return filled_from_neighbours(graph, std::move(count), std::move(sum));
}

CurveGraph centre_nodes(const CurveGraph& graph, const TriMesh& mesh,
                        std::span<const std::uint32_t> node_of_vertex) {
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<Vec3> sum(graph.nodes.size(), Vec3::Zero());
  std::vector<double> weight(graph.nodes.size(), 0.0);
  for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
    const std::uint32_t node = node_of_vertex[v];
    if (node != Skeleton::kNone) {
      sum[node] += areas[v] * (mesh.positions[v] - graph.nodes[node]);
      weight[node] += areas[v];
    }
  }
  CurveGraph centred = graph;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (weight[i] > 0.0) {
      centred.nodes[i] += sum[i] / weight[i];
    }
  }
  centred.nodes = smoothed_along_chains(centred.nodes, node_neighbours(graph));
  return centred;
}

CurveGraph without_merged(const CurveGraph& graph, std::vector<std::uint32_t> stands_for,
                          std::vector<std::uint32_t>& node_of_vertex) {
  CurveGraph kept;
  std::vector<std::uint32_t> new_of_old(graph.nodes.size(), Skeleton::kNone);
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    if (stands_for[i] == i) {
      new_of_old[i] = static_cast<std::uint32_t>(kept.nodes.size());
      kept.nodes.push_back(graph.nodes[i]);
    }
  }
  for (const auto& [a, b] : graph.edges) {
    if (stands_for[a] == a && stands_for[b] == b) {
      kept.edges.push_back({new_of_old[a], new_of_old[b]});
    }
  }
  for (std::uint32_t& node : node_of_vertex) {
    if (node != Skeleton::kNone) {
      // A junction may itself have been cut later as part of a longer end, so chains can be a thousand long:
      // they are followed with path halving.
      while (stands_for[node] != node) {
        node = stands_for[node] = stands_for[stands_for[node]];
      }
      node = new_of_old[node];
    }
  }
  return kept;
}

CurveGraph prune_ends(const CurveGraph& graph, double ratio, const std::vector<double>& radius,
                      std::vector<std::uint32_t>& node_of_vertex) {
  return without_merged(graph, Ends(graph, ratio, radius).cut(), node_of_vertex);
}

}  // namespace vantage
