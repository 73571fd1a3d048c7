// SPDX-License-Identifier: MIT
#include "vantage/mesh/curve_graph.h"

#include <algorithm>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace vantage {
namespace {

/// Walks from `start` over `next` until a node that is not in the middle of a chain, or `start`.
std::vector<std::uint32_t> walk(const IndexLists& lists, std::uint32_t start, std::uint32_t next) {
  std::vector<std::uint32_t> run{start, next};
  while (run.back() != start && lists[run.back()].size() == 2) {
    const auto pair = lists[run.back()];
    run.push_back(pair[0] == run[run.size() - 2] ? pair[1] : pair[0]);
  }
  return run;
}

}  // namespace

IndexLists node_neighbours(const CurveGraph& graph) {
  IndexLists lists;
  for (const std::uint32_t degree : node_degrees(graph)) {
    lists.offsets.push_back(lists.offsets.back() + degree);
  }
  lists.values.resize(lists.offsets.back());
  std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
  for (const auto& [a, b] : graph.edges) {
    lists.values[next[a]++] = b;
    lists.values[next[b]++] = a;
  }
  return lists;
}

std::vector<Vec3> smoothed_along_chains(std::span<const Vec3> positions,
                                        const IndexLists& neighbours) {
  std::vector<Vec3> smooth(positions.begin(), positions.end());
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    if (const std::span<const std::uint32_t> around = neighbours[i]; around.size() == 2) {
      smooth[i] = 0.5 * positions[i] + 0.25 * (positions[around[0]] + positions[around[1]]);
    }
  }
  return smooth;
}

std::size_t component_count(const CurveGraph& graph) {
  DisjointSets sets(graph.nodes.size());
  std::size_t count = graph.nodes.size();
  for (const auto& [a, b] : graph.edges) {
    if (sets.join(a, b)) {
      --count;
    }
  }
  return count;
}

std::size_t cycle_count(const CurveGraph& graph) {
  return graph.edges.size() + component_count(graph) - graph.nodes.size();
}

std::vector<std::uint32_t> node_degrees(const CurveGraph& graph) {
  std::vector<std::uint32_t> degree(graph.nodes.size(), 0);
  for (const auto& [a, b] : graph.edges) {
    ++degree[a];
    ++degree[b];
  }
  return degree;
}

std::vector<std::vector<std::uint32_t>> graph_branches(const CurveGraph& graph) {
  const IndexLists lists = node_neighbours(graph);
  std::vector<std::vector<std::uint32_t>> branches;
  std::vector<bool> done(graph.nodes.size(), false);  // only of nodes within chains
  const auto add_from = [&](std::uint32_t start) {
    for (const std::uint32_t next : lists[start]) {
      std::vector<std::uint32_t> run = walk(lists, start, next);
      std::vector<std::uint32_t> reversed(run.rbegin(), run.rend());
      if (run <= reversed) {  // the other way around is found from the other end
        for (const std::uint32_t node : run) {
          done[node] = true;
        }
        branches.push_back(std::move(run));
      }
    }
  };
  for (std::uint32_t i = 0; i < lists.size(); ++i) {
    if (lists[i].size() != 2) {
      add_from(i);
    }
  }
  for (std::uint32_t i = 0; i < lists.size(); ++i) {
    if (lists[i].size() == 2 && !done[i]) {
      add_from(i);
    }
  }
  std::sort(branches.begin(), branches.end());
  return branches;
}

double total_length(const CurveGraph& graph) {
  double length = 0.0;
  for (const auto& [a, b] : graph.edges) {
    length += (graph.nodes[a] - graph.nodes[b]).norm();
  }
  return length;
}

}  // namespace vantage
