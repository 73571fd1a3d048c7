// SPDX-License-Identifier: MIT
#include "vantage/mesh/curve_graph.h"

#include "mesh/disjoint_sets.h"

namespace vantage {

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

double total_length(const CurveGraph& graph) {
  double length = 0.0;
  for (const auto& [a, b] : graph.edges) {
    length += (graph.nodes[a] - graph.nodes[b]).norm();
  }
  return length;
}

}  // namespace vantage
