// SPDX-License-Identifier: MIT
#include "skeleton/point_skeleton.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

#include "skeleton/cloud_graph.h"
#include "skeleton/collapsed.h"
#include "skeleton/embedding.h"

namespace vantage {
namespace {

constexpr double kCircumference = 2.0 * std::numbers::pi;  // over the radius
constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// A loop of a graph.
struct Loop {
  std::vector<std::uint32_t> nodes{};  ///< In order.
  double length = kUnreached;
};

/// The shortest loop over an edge, without nodes if it is longer than `most`.
Loop loop_over(const CurveGraph& graph, const IndexLists& lists, std::array<std::uint32_t, 2> edge,
               double most) {
  const auto span = [&graph](std::uint32_t a, std::uint32_t b) {
    return (graph.nodes[a] - graph.nodes[b]).norm();
  };
  std::vector<double> distance(graph.nodes.size(), kUnreached);
  std::vector<std::uint32_t> from(graph.nodes.size(), Skeleton::kNone);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[edge[0]] = span(edge[0], edge[1]);
  queue.push({distance[edge[0]], edge[0]});
  while (!queue.empty()) {
    const auto [d, node] = queue.top();
    queue.pop();
    if (d > distance[node]) {
      continue;
    }
    if (node == edge[1]) {
      break;
    }
    for (const std::uint32_t next : lists[node]) {
      const double reached = d + span(node, next);
      const bool over_edge = node == edge[0] && next == edge[1];
      if (!over_edge && reached < distance[next] && reached <= most) {
        distance[next] = reached;
        from[next] = node;
        queue.push({reached, next});
      }
    }
  }
  Loop loop{.length = distance[edge[1]]};
  for (std::uint32_t n = edge[1]; loop.length < kUnreached && n != Skeleton::kNone; n = from[n]) {
    loop.nodes.push_back(n);
  }
  return loop;
}

/// Turns the loop so that it starts at one of its two nodes that are farthest apart.
/// \return where the other then stands.
std::size_t turn_to_ends(const CurveGraph& graph, std::vector<std::uint32_t>& loop) {
  std::array<std::size_t, 2> ends{0, 1};
  double most = -1.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (std::size_t j = i + 1; j < loop.size(); ++j) {
      const double d = (graph.nodes[loop[i]] - graph.nodes[loop[j]]).squaredNorm();
      if (d > most) {
        most = d;
        ends = {i, j};
      }
    }
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(ends[0]), loop.end());
  return ends[1] - ends[0];
}

/// The graph after some of its nodes became one at their mean.
/// \param into for each node the lowest of those that it becomes one with.
CurveGraph merge_nodes(const CurveGraph& graph, const std::vector<std::uint32_t>& into,
                       std::vector<std::uint32_t>& node_of_vertex) {
  std::vector<Vec3> sum(graph.nodes.size(), Vec3::Zero());
  std::vector<double> count(graph.nodes.size(), 0.0);
  for (std::uint32_t n = 0; n < into.size(); ++n) {
    sum[into[n]] += graph.nodes[n];
    count[into[n]] += 1.0;
  }
  CurveGraph merged;
  std::vector<std::uint32_t> new_of_old(graph.nodes.size());
  for (std::uint32_t n = 0; n < into.size(); ++n) {
    if (into[n] == n) {
      new_of_old[n] = static_cast<std::uint32_t>(merged.nodes.size());
      merged.nodes.emplace_back(sum[n] / count[n]);
    } else {
      new_of_old[n] = new_of_old[into[n]];
    }
  }
  for (const auto& [a, b] : graph.edges) {
    const auto [low, high] = std::minmax(new_of_old[a], new_of_old[b]);
    if (low != high) {
      merged.edges.push_back({low, high});
    }
  }
  std::sort(merged.edges.begin(), merged.edges.end());
  merged.edges.erase(std::unique(merged.edges.begin(), merged.edges.end()), merged.edges.end());
  for (std::uint32_t& node : node_of_vertex) {
    node = node == Skeleton::kNone ? node : new_of_old[node];
  }
  return merged;
}

/// Folds a loop flat between its two ends: nodes at the same share of the way on either side become
/// one. Where one side is a single edge, that edge goes.
CurveGraph fold_loop(CurveGraph graph, std::vector<std::uint32_t> loop,
                     std::vector<std::uint32_t>& node_of_vertex) {
  const std::size_t end = turn_to_ends(graph, loop);
  const std::size_t there = end - 1;
  const std::size_t back = loop.size() - end - 1;
  const std::size_t groups = std::min(there, back);
  if (groups == 0) {
    const auto [low, high] = std::minmax(loop[0], loop[end]);
    std::erase(graph.edges, std::array{low, high});
    return graph;
  }
  std::vector<std::uint32_t> lowest(groups, Skeleton::kNone);
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < there; ++i) {
      visit(loop[1 + i], i * groups / there);
    }
    for (std::size_t i = 0; i < back; ++i) {
      visit(loop[loop.size() - 1 - i], i * groups / back);
    }
  };
  each([&](std::uint32_t node, std::size_t group) {
    lowest[group] = std::min(lowest[group], node);
  });
  std::vector<std::uint32_t> into(graph.nodes.size());
  std::iota(into.begin(), into.end(), 0U);
  each([&](std::uint32_t node, std::size_t group) { into[node] = lowest[group]; });
  return merge_nodes(graph, into, node_of_vertex);
}

/// Folds loops that are too short for their radius, the shortest first.
void close_short_loops(CurveGraph& graph, const TriMesh& samples,
                       std::vector<std::uint32_t>& node_of_vertex, const RunContext& run) {
  while (cycle_count(graph) > 0) {
    run.check();
    const std::vector<double> radius = node_radii(graph, samples, node_of_vertex);
    const IndexLists lists = node_neighbours(graph);
    double most = kCircumference * *std::max_element(radius.begin(), radius.end());
    std::vector<std::uint32_t> shortest;
    for (const auto& edge : graph.edges) {
      Loop loop = loop_over(graph, lists, edge, most);
      double mean = 0.0;
      for (const std::uint32_t n : loop.nodes) {
        mean += radius[n] / static_cast<double>(loop.nodes.size());
      }
      if (!loop.nodes.empty() && loop.length < most && loop.length < kCircumference * mean) {
        most = loop.length;
        shortest = std::move(loop.nodes);
      }
    }
    if (shortest.empty()) {
      return;
    }
    graph = fold_loop(std::move(graph), std::move(shortest), node_of_vertex);
  }
}

}  // namespace

Skeleton extract_point_skeleton(const TriMesh& samples, const ContractionHistory& history,
                                const SkeletonOptions& options, const RunContext& run) {
  check_fields(options, kSkeletonFields);
  const double spacing = sample_spacing(samples, options);
  Skeleton skeleton =
      finish_skeleton(samples, history, thin_cloud(samples, history, spacing, run.part(0.0, 0.9)),
                      shell_to_finish(samples, history).get(), options, run);
  close_short_loops(skeleton.raw, samples, skeleton.raw_node_of_vertex, run);
  skeleton.curve = skeleton.raw;
  close_short_loops(skeleton.graph, samples, skeleton.node_of_vertex, run);
  if (options.prune) {  // folding leaves stubs
    const std::vector<double> radius = node_radii(skeleton.graph, samples, skeleton.node_of_vertex);
    skeleton.graph =
        prune_ends(skeleton.graph, options.prune_ratio, radius, skeleton.node_of_vertex);
  }
  skeleton.radius = node_radii(skeleton.graph, samples, skeleton.node_of_vertex);
  return skeleton;
}

}  // namespace vantage
