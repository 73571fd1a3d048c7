// SPDX-License-Identifier: MIT
#include "vantage/skeleton/point_skeleton.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "skeleton/embedding.h"

namespace vantage {
namespace {

constexpr double kCircumference = 2.0 * std::numbers::pi;  // over the radius
constexpr double kFar = std::numeric_limits<double>::infinity();

using Adjacency = std::vector<std::vector<std::uint32_t>>;

/// The nodes of the shortest loop over an edge, in order, or none if it is longer than `most`.
std::vector<std::uint32_t> loop_over(const CurveGraph& graph, const Adjacency& lists,
                                     std::array<std::uint32_t, 2> edge, double most,
                                     double& length) {
  const auto span = [&graph](std::uint32_t a, std::uint32_t b) {
    return (graph.nodes[a] - graph.nodes[b]).norm();
  };
  std::vector<double> distance(graph.nodes.size(), kFar);
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
  length = distance[edge[1]];
  std::vector<std::uint32_t> loop;
  for (std::uint32_t n = edge[1]; length < kFar && n != Skeleton::kNone; n = from[n]) {
    loop.push_back(n);
  }
  return loop;
}

/// Merges the nodes of a loop into one at their mean.
CurveGraph merge_loop(const CurveGraph& graph, std::vector<std::uint32_t> loop,
                      std::vector<std::uint32_t>& node_of_vertex) {
  std::sort(loop.begin(), loop.end());
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t n : loop) {
    mean += graph.nodes[n] / static_cast<double>(loop.size());
  }
  CurveGraph merged;
  std::vector<std::uint32_t> new_of_old(graph.nodes.size());
  for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
    const bool on_loop = std::binary_search(loop.begin(), loop.end(), n);
    if (on_loop && n != loop.front()) {
      new_of_old[n] = new_of_old[loop.front()];
      continue;
    }
    new_of_old[n] = static_cast<std::uint32_t>(merged.nodes.size());
    merged.nodes.push_back(on_loop ? mean : graph.nodes[n]);
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

/// Closes loops that are too short for their radius, the shortest first.
void close_short_loops(CurveGraph& graph, const TriMesh& samples,
                       std::vector<std::uint32_t>& node_of_vertex, const RunContext& run) {
  while (cycle_count(graph) > 0) {
    run.check();
    const std::vector<double> radius = node_radii(graph, samples, node_of_vertex);
    Adjacency lists(graph.nodes.size());
    for (const auto& [a, b] : graph.edges) {
      lists[a].push_back(b);
      lists[b].push_back(a);
    }
    double most = kCircumference * *std::max_element(radius.begin(), radius.end());
    std::vector<std::uint32_t> shortest;
    for (const auto& edge : graph.edges) {
      double length = kFar;
      std::vector<std::uint32_t> loop = loop_over(graph, lists, edge, most, length);
      double mean = 0.0;
      for (const std::uint32_t n : loop) {
        mean += radius[n] / static_cast<double>(loop.size());
      }
      if (!loop.empty() && length < most && length < kCircumference * mean) {
        most = length;
        shortest = std::move(loop);
      }
    }
    if (shortest.empty()) {
      return;
    }
    graph = merge_loop(graph, std::move(shortest), node_of_vertex);
  }
}

}  // namespace

Skeleton extract_point_skeleton(const TriMesh& samples, const ContractionHistory& history,
                                const SkeletonOptions& options, const RunContext& run) {
  Skeleton skeleton = extract_skeleton(samples, history, options, run);
  close_short_loops(skeleton.raw, samples, skeleton.raw_node_of_vertex, run);
  close_short_loops(skeleton.graph, samples, skeleton.node_of_vertex, run);
  skeleton.radius = node_radii(skeleton.graph, samples, skeleton.node_of_vertex);
  return skeleton;
}

}  // namespace vantage
