// SPDX-License-Identifier: MIT
#include "skeleton/wall_middles.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace vantage {
namespace {

/// What the way to a node's neighbours counts beside the way to its wall: so little that it decides
/// between walls about equally near. [ours: at 0.5 and 1 an edge of a thin part found no way inside]
constexpr double kNeighbours = 0.25;
constexpr int kTimesAgain = 2;  // that nodes are moved once all their neighbours are settled [ours]

}  // namespace

WallMiddles::WallMiddles(CurveGraph graph, const Shell& shell)
    : graph_(std::move(graph)),
      shell_(shell),
      place_(graph_.nodes),
      order_(place_),
      neighbours_(node_neighbours(graph_)),
      middles_(place_.size()),
      settled_(place_.size(), true) {}

bool WallMiddles::add(std::uint32_t node, const std::vector<std::uint32_t>& vertices) {
  for (const std::uint32_t v : vertices) {
    if (const std::optional<Vec3> middle = shell_.middle_at(v)) {
      middles_[node].push_back(*middle);
    }
  }
  settled_[node] = middles_[node].empty();
  return !middles_[node].empty();
}

CurveGraph WallMiddles::move() {
  const std::vector<std::uint32_t> moved = nearest_first();
  for (std::vector<std::uint32_t> waiting = moved; !waiting.empty();) {
    settle(take_next(waiting));
  }
  for (int again = 0; again < kTimesAgain; ++again) {
    settle(moved);
  }
  return std::move(graph_);
}

/// The nodes to move, those nearest to a middle first.
std::vector<std::uint32_t> WallMiddles::nearest_first() const {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> ranks;
  for (std::uint32_t node = 0; node < place_.size(); ++node) {
    if (!settled_[node]) {
      ranks.emplace_back(order_.steps(way_to(best_middle(node), node)),
                         order_.place(place_[node], place_[node]), node);
    }
  }
  std::sort(ranks.begin(), ranks.end());
  std::vector<std::uint32_t> nodes;
  nodes.reserve(ranks.size());
  for (const auto& rank : ranks) {
    nodes.push_back(std::get<2>(rank));
  }
  return nodes;
}

/// The nodes beside settled ones; if there are none, the first.
std::vector<std::uint32_t> WallMiddles::take_next(std::vector<std::uint32_t>& waiting) const {
  auto rest = std::stable_partition(waiting.begin(), waiting.end(), [this](std::uint32_t node) {
    return has_settled_neighbour(node);
  });
  rest += rest == waiting.begin() ? 1 : 0;
  std::vector<std::uint32_t> next(waiting.begin(), rest);
  waiting.erase(waiting.begin(), rest);
  return next;
}

/// Moves all of them beside what was settled before: none depends on which comes first.
void WallMiddles::settle(const std::vector<std::uint32_t>& nodes) {
  std::vector<Vec3> chosen;
  chosen.reserve(nodes.size());
  for (const std::uint32_t node : nodes) {
    chosen.push_back(best_middle(node));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    graph_.nodes[nodes[i]] = chosen[i];
    settled_[nodes[i]] = true;
  }
}

bool WallMiddles::has_settled_neighbour(std::uint32_t node) const {
  return std::any_of(neighbours_[node].begin(), neighbours_[node].end(),
                     [this](std::uint32_t c) { return settled_[c]; });
}

/// How long the way is from where the node should be to the middle, and on to its settled neighbours.
double WallMiddles::way_to(const Vec3& middle, std::uint32_t node) const {
  double sum = 0.0;
  double count = 0.0;
  for (const std::uint32_t c : neighbours_[node]) {
    if (settled_[c]) {
      sum += (middle - graph_.nodes[c]).norm();
      count += 1.0;
    }
  }
  return (middle - place_[node]).norm() + (count > 0.0 ? kNeighbours * sum / count : 0.0);
}

const Vec3& WallMiddles::best_middle(std::uint32_t node) const {
  const auto rank = [&](const Vec3& middle) {
    return std::tuple(order_.steps(way_to(middle, node)), order_.place(middle, middle));
  };
  return *std::min_element(middles_[node].begin(), middles_[node].end(),
                           [&rank](const Vec3& a, const Vec3& b) { return rank(a) < rank(b); });
}

}  // namespace vantage
