// SPDX-License-Identifier: MIT
#include "skeleton/routing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "vantage/skeleton/skeleton.h"

namespace vantage {
namespace {

/// How often a part of an edge may be split again: at most 2⁵ parts.
constexpr int kMostSplits = 5;
/// Half of a split edge over the whole, at most.
constexpr double kMostDetour = 1.5;

/// The vertices of each node, ascending.
std::vector<std::vector<std::uint32_t>> vertices_of_nodes(
    std::size_t node_count, std::span<const std::uint32_t> node_of_vertex) {
  std::vector<std::vector<std::uint32_t>> lists(node_count);
  for (std::uint32_t v = 0; v < node_of_vertex.size(); ++v) {
    if (node_of_vertex[v] != Skeleton::kNone) {
      lists[node_of_vertex[v]].push_back(v);
    }
  }
  return lists;
}

/// The middle of a wall, of those at the given vertices, that is nearest to a place.
class NearestMiddle {
 public:
  NearestMiddle(const Shell& shell, const Vec3& place) : shell_(shell), place_(place) {}

  void look_at(std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t v : vertices) {
      Vec3 middle = Vec3::Zero();
      if (shell_.middle_at(v, middle) && (middle - place_).squaredNorm() < distance_squared_) {
        distance_squared_ = (middle - place_).squaredNorm();
        nearest_ = middle;
        found_ = true;
      }
    }
  }

  [[nodiscard]] bool found() const { return found_; }

  [[nodiscard]] const Vec3& nearest() const { return nearest_; }

 private:
  const Shell& shell_;
  Vec3 place_;
  double distance_squared_ = std::numeric_limits<double>::infinity();
  Vec3 nearest_ = Vec3::Zero();
  bool found_ = false;
};

/// A piece of an edge of the graph that is yet to be looked at.
struct Piece {
  std::uint32_t a;
  std::uint32_t b;
  int splits;  ///< How many splits made it.
};

class EdgeRouter {
 public:
  EdgeRouter(CurveGraph graph, const Routing& routing, std::vector<std::uint32_t>& node_of_vertex)
      : graph_(std::move(graph)),
        routing_(routing),
        node_of_vertex_(node_of_vertex),
        vertices_(vertices_of_nodes(graph_.nodes.size(), node_of_vertex)) {}

  CurveGraph route() {
    std::vector<Piece> open;
    for (const auto& [a, b] : graph_.edges) {
      open.push_back({a, b, 0});
    }
    graph_.edges.clear();
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      const std::optional<std::uint32_t> middle = split(piece);
      if (middle) {
        open.push_back({piece.a, *middle, piece.splits + 1});
        open.push_back({*middle, piece.b, piece.splits + 1});
      } else {
        graph_.edges.push_back({std::min(piece.a, piece.b), std::max(piece.a, piece.b)});
      }
    }
    std::sort(graph_.edges.begin(), graph_.edges.end());
    return std::move(graph_);
  }

 private:
  /// The node that was put into the piece; nothing if it may stay as it is.
  std::optional<std::uint32_t> split(const Piece& piece) {
    const auto [a, b, splits] = piece;
    const auto& some = vertices_[a].empty() ? vertices_[b] : vertices_[a];
    if (splits == kMostSplits || some.empty() ||
        routing_.shell.inside(routing_.component_of_vertex[some.front()], graph_.nodes[a],
                              graph_.nodes[b])) {
      return std::nullopt;
    }
    NearestMiddle middle(routing_.shell, 0.5 * (graph_.nodes[a] + graph_.nodes[b]));
    middle.look_at(vertices_[a]);
    middle.look_at(vertices_[b]);
    if (!middle.found() || !leads_somewhere(middle.nearest(), graph_.nodes[a], graph_.nodes[b])) {
      return std::nullopt;
    }
    const auto node = static_cast<std::uint32_t>(graph_.nodes.size());
    graph_.nodes.push_back(middle.nearest());
    vertices_.emplace_back();
    hand_over(a, node);
    hand_over(b, node);
    return node;
  }

  /// Whether neither half is much longer than the whole: a detour that grows leads nowhere.
  static bool leads_somewhere(const Vec3& middle, const Vec3& a, const Vec3& b) {
    const double longest_squared = kMostDetour * kMostDetour * (a - b).squaredNorm();
    return (middle - a).squaredNorm() < longest_squared &&
           (middle - b).squaredNorm() < longest_squared;
  }

  /// Gives the vertices of `from` that are nearer to `to` to it, but never all of them.
  void hand_over(std::uint32_t from, std::uint32_t to) {
    const auto is_nearer = [&](std::uint32_t v) {
      const Vec3& p = routing_.mesh.positions[v];
      return (p - graph_.nodes[to]).squaredNorm() < (p - graph_.nodes[from]).squaredNorm();
    };
    auto& own = vertices_[from];
    const auto first_nearer = std::stable_partition(own.begin(), own.end(),
                                                    [&](std::uint32_t v) { return !is_nearer(v); });
    if (first_nearer == own.begin()) {
      return;
    }
    for (auto v = first_nearer; v != own.end(); ++v) {
      node_of_vertex_[*v] = to;
      vertices_[to].push_back(*v);
    }
    own.erase(first_nearer, own.end());
  }

  CurveGraph graph_;
  const Routing& routing_;
  std::vector<std::uint32_t>& node_of_vertex_;
  std::vector<std::vector<std::uint32_t>> vertices_;
};

}  // namespace

CurveGraph move_nodes_inside(const CurveGraph& centred, const CurveGraph& raw,
                             const Routing& routing,
                             std::span<const std::uint32_t> node_of_vertex) {
  CurveGraph graph = centred;
  const auto vertices = vertices_of_nodes(graph.nodes.size(), node_of_vertex);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (vertices[i].empty()) {
      continue;
    }
    const std::uint32_t component = routing.component_of_vertex[vertices[i].front()];
    const Vec3 half_way = 0.5 * (centred.nodes[i] + raw.nodes[i]);
    const std::array places{centred.nodes[i], half_way, raw.nodes[i]};
    const auto* const place = std::find_if(places.begin(), places.end(), [&](const Vec3& p) {
      return routing.shell.inside(component, p);
    });
    if (place != places.end()) {
      graph.nodes[i] = *place;
      continue;
    }
    NearestMiddle middle(routing.shell, centred.nodes[i]);
    middle.look_at(vertices[i]);
    graph.nodes[i] = middle.found() ? middle.nearest() : centred.nodes[i];
  }
  return graph;
}

CurveGraph route_edges_inside(CurveGraph graph, const Routing& routing,
                              std::vector<std::uint32_t>& node_of_vertex) {
  EdgeRouter router(std::move(graph), routing, node_of_vertex);
  return router.route();
}

}  // namespace vantage
