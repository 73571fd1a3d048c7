// SPDX-License-Identifier: MIT
#include "mesh/close_nodes.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "mesh/disjoint_sets.h"
#include "mesh/place_order.h"

namespace vantage {
namespace {

struct Pair {
  std::uint32_t steps;  ///< The length in steps of PlaceOrder, as are places.
  std::uint32_t place;
  std::uint32_t a, b;
  double length;

  bool operator<(const Pair& other) const {  // min-heap
    return std::tie(other.steps, other.place, other.a, other.b) < std::tie(steps, place, a, b);
  }
};

/// A graph under merging: nodes with sorted neighbour lists.
class MergingGraph {
 public:
  MergingGraph(const CurveGraph& graph, std::vector<double> weight)
      : position_(graph.nodes), weight_(std::move(weight)), merged_(graph.nodes.size()) {
    const IndexLists lists = node_neighbours(graph);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      neighbours_.emplace_back(lists[i].begin(), lists[i].end());
      std::sort(neighbours_.back().begin(), neighbours_.back().end());
    }
  }

  [[nodiscard]] bool linked(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(neighbours_[a].begin(), neighbours_[a].end(), b);
  }

  /// Merging both would close a triangle of the graph and lose its cycle.
  [[nodiscard]] bool share_a_neighbour(std::uint32_t a, std::uint32_t b) const {
    if (neighbours_[b].size() < neighbours_[a].size()) {
      std::swap(a, b);  // one may be a hub
    }
    return std::any_of(neighbours_[a].begin(), neighbours_[a].end(),
                       [&](std::uint32_t c) { return linked(b, c); });
  }

  [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const {
    return (position_[a] - position_[b]).norm();
  }

  [[nodiscard]] const std::vector<std::uint32_t>& neighbours(std::uint32_t a) const {
    return neighbours_[a];
  }

  /// Returns the neighbours of `keep` that it has another edge to than before: all if it moved.
  /// \pre keep < gone.
  [[nodiscard]] std::vector<std::uint32_t> merge(std::uint32_t keep, std::uint32_t gone) {
    const Vec3 before = position_[keep];
    const bool keep_fixed = neighbours_[keep].size() != 2;
    const bool gone_fixed = neighbours_[gone].size() != 2;
    // Between an end and a junction, the junction stays: a spur shorter than the spacing is no limb.
    // Of two junctions that of more branches, then that of more vertices.
    const bool gone_wins =
        gone_fixed && (!keep_fixed || std::pair(neighbours_[gone].size(), weight_[gone]) >
                                          std::pair(neighbours_[keep].size(), weight_[keep]));
    const double total = weight_[keep] + weight_[gone];
    if (gone_wins) {
      position_[keep] = position_[gone];
    } else if (!keep_fixed && !(total > 0.0)) {
      position_[keep] = 0.5 * (position_[keep] + position_[gone]);  // both made by refinement
    } else if (!keep_fixed) {
      position_[keep] = (weight_[keep] * position_[keep] + weight_[gone] * position_[gone]) / total;
    }
    weight_[keep] = total;
    merged_.join(keep, gone);
    std::vector<std::uint32_t> changed = std::exchange(neighbours_[gone], {});
    for (const std::uint32_t c : changed) {
      erase(c, gone);
      if (c != keep && !linked(keep, c)) {
        insert(keep, c);
        insert(c, keep);
      }
    }
    std::erase(changed, keep);
    return position_[keep] == before ? changed : neighbours_[keep];
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t node) { return merged_.root(node); }

  [[nodiscard]] const Vec3& position(std::uint32_t node) const { return position_[node]; }

  [[nodiscard]] std::size_t size() const { return position_.size(); }

 private:
  void erase(std::uint32_t a, std::uint32_t b) {
    auto& list = neighbours_[a];
    list.erase(std::lower_bound(list.begin(), list.end(), b));
  }

  void insert(std::uint32_t a, std::uint32_t b) {
    auto& list = neighbours_[a];
    list.insert(std::lower_bound(list.begin(), list.end(), b), b);
  }

  std::vector<Vec3> position_;
  std::vector<double> weight_;
  std::vector<std::vector<std::uint32_t>> neighbours_{};
  DisjointSets merged_;
};

}  // namespace

CurveGraph merge_close_nodes(const CurveGraph& graph, double spacing, std::vector<double> weight,
                             std::vector<std::uint32_t>& node_of_vertex) {
  MergingGraph merging(graph, std::move(weight));
  const PlaceOrder order(graph.nodes);
  std::priority_queue<Pair> queue;
  const auto offer = [&](std::uint32_t a, std::uint32_t b) {
    const double length = merging.distance(a, b);
    if (length < spacing) {
      const std::uint32_t place = order.place(merging.position(a), merging.position(b));
      queue.push({order.steps(length), place, std::min(a, b), std::max(a, b), length});
    }
  };
  for (const auto& [a, b] : graph.edges) {
    offer(a, b);
  }
  while (!queue.empty()) {
    const auto [steps, place, a, b, length] = queue.top();
    queue.pop();
    if (!merging.linked(a, b) || merging.distance(a, b) != length ||
        merging.share_a_neighbour(a, b)) {
      continue;
    }
    // A pair refused for a common neighbour keeps having one, so only edges that the merge changed are
    // offered again.
    for (const std::uint32_t c : merging.merge(a, b)) {
      offer(a, c);
    }
  }

  constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
  CurveGraph result;
  std::vector<std::uint32_t> new_of_old(merging.size(), kUnset);
  for (std::uint32_t i = 0; i < merging.size(); ++i) {
    if (merging.root(i) == i) {
      new_of_old[i] = static_cast<std::uint32_t>(result.nodes.size());
      result.nodes.push_back(merging.position(i));
    }
  }
  for (std::uint32_t i = 0; i < merging.size(); ++i) {
    for (const std::uint32_t c : merging.neighbours(i)) {
      if (i < c) {
        result.edges.push_back({new_of_old[i], new_of_old[c]});
      }
    }
  }
  std::sort(result.edges.begin(), result.edges.end());
  for (std::uint32_t& node : node_of_vertex) {
    if (node != kUnset) {
      node = new_of_old[merging.root(node)];
    }
  }
  return result;
}

}  // namespace vantage
