// SPDX-License-Identifier: MIT
#include "skeleton/embedding.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/skeleton/skeleton.h"

namespace vantage {
namespace {

using Adjacency = std::vector<std::vector<std::uint32_t>>;

/// An end of the graph: the nodes from its tip up to, not including, the junction.
struct End {
  double length = 0.0;
  std::uint32_t junction = Skeleton::kNone;
  std::vector<std::uint32_t> nodes{};
};

/// Walks from a tip to the first junction; no junction is found on a plain path.
End walk_from(std::uint32_t tip, const Adjacency& lists, const CurveGraph& graph) {
  End end;
  std::uint32_t previous = Skeleton::kNone;
  std::uint32_t node = tip;
  while (lists[node].size() <= 2) {
    end.nodes.push_back(node);
    std::uint32_t next = Skeleton::kNone;
    for (const std::uint32_t c : lists[node]) {
      next = c != previous ? c : next;
    }
    if (next == Skeleton::kNone) {
      return {};
    }
    end.length += (graph.nodes[next] - graph.nodes[node]).norm();
    previous = node;
    node = next;
  }
  end.junction = node;
  return end;
}

/// The shortest end that is shorter than its junction is thick; its junction is kNone if none is.
End shortest_spurious_end(const CurveGraph& graph, const Adjacency& lists, double ratio,
                          const std::vector<double>& radius) {
  End best;
  best.length = std::numeric_limits<double>::infinity();
  for (std::uint32_t tip = 0; tip < graph.nodes.size(); ++tip) {
    if (lists[tip].size() != 1) {
      continue;
    }
    End end = walk_from(tip, lists, graph);
    if (end.junction != Skeleton::kNone && end.length < ratio * radius[end.junction] &&
        end.length < best.length) {
      best = std::move(end);
    }
  }
  return best;
}

/// Radii in which nodes that stand for no vertex have the mean of their neighbours, ring by ring.
/// \param count of vertices of each node.
std::vector<double> filled_from_neighbours(const CurveGraph& graph, std::vector<double> count,
                                           std::vector<double> radius) {
  const Adjacency lists = node_neighbours(graph);
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

CurveGraph without_merged(const CurveGraph& graph, const std::vector<std::uint32_t>& stands_for,
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
      // A junction may itself have become part of a longer end that was cut later.
      while (stands_for[node] != node) {
        node = stands_for[node];
      }
      node = new_of_old[node];
    }
  }
  return kept;
}

CurveGraph prune_ends(const CurveGraph& graph, double ratio, const std::vector<double>& radius,
                      std::vector<std::uint32_t>& node_of_vertex) {
  Adjacency lists = node_neighbours(graph);
  std::vector<std::uint32_t> stands_for(graph.nodes.size());
  for (std::uint32_t i = 0; i < stands_for.size(); ++i) {
    stands_for[i] = i;
  }
  for (;;) {
    const End end = shortest_spurious_end(graph, lists, ratio, radius);
    if (end.junction == Skeleton::kNone) {
      break;
    }
    std::erase(lists[end.junction], end.nodes.back());
    for (const std::uint32_t node : end.nodes) {
      lists[node].clear();
      stands_for[node] = end.junction;
    }
  }

  return without_merged(graph, stands_for, node_of_vertex);
}

}  // namespace vantage
