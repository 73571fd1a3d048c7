// SPDX-License-Identifier: MIT
#include "skeleton/routing.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "vantage/skeleton/skeleton.h"

#include "mesh/disjoint_sets.h"
#include "mesh/place_order.h"
#include "skeleton/wall_middles.h"
#include "spatial/interior_path.h"

namespace vantage {
namespace {

/// How far a way may leave the part of the surface that its edge stands for, in edges [ours].
constexpr int kMostRings = 2;

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

class EdgeRouter {
 public:
  EdgeRouter(CurveGraph graph, const Routing& routing, std::vector<std::uint32_t>& node_of_vertex)
      : graph_(std::move(graph)),
        routing_(routing),
        node_of_vertex_(node_of_vertex),
        component_(components_of_nodes(graph_, node_of_vertex, routing.component_of_vertex)),
        vertices_(vertices_of_nodes(graph_.nodes.size(), node_of_vertex)),
        neighbours_(node_neighbours(graph_)) {}

  /// Every way is looked for below the same vertices, and only then do the new nodes take theirs:
  /// no way depends on which edge comes first.
  CurveGraph route() {
    const std::vector<std::array<std::uint32_t, 2>> edges = std::move(graph_.edges);
    graph_.edges.clear();
    for (const auto& [a, b] : edges) {
      routing_.run.check();
      const std::uint32_t component = component_[a];
      if (component == Skeleton::kNone ||
          routing_.shell.inside(component, graph_.nodes[a], graph_.nodes[b])) {
        graph_.edges.push_back({a, b});
      } else {
        lead(a, b, way(component, a, b));
      }
    }
    sort_ways();
    for (const Way& way : ways_) {
      hand_over(way.ends[0], way.corners);
      hand_over(way.ends[1], way.corners);
    }
    std::sort(graph_.edges.begin(), graph_.edges.end());
    return std::move(graph_);
  }

 private:
  /// What replaced an edge: new nodes between its ends.
  struct Way {
    std::array<std::uint32_t, 2> ends;
    std::vector<std::uint32_t> corners;
  };

  /// Corners of a way inside below the vertices of both nodes or, if there is none, also below those
  /// of the nodes up to kMostRings edges away; none if there is no such way either.
  std::vector<Vec3> way(std::uint32_t component, std::uint32_t a, std::uint32_t b) {
    if (!paths_) {
      paths_.emplace(routing_.mesh, routing_.shell);
    }
    std::vector<std::uint32_t> around{a, b};
    for (int ring = 0; ring <= kMostRings && !paths_->is_spent(); ++ring) {
      std::vector<std::uint32_t> vertices;
      for (const std::uint32_t node : around) {
        vertices.insert(vertices.end(), vertices_[node].begin(), vertices_[node].end());
      }
      if (auto corners = paths_->find(component, graph_.nodes[a], graph_.nodes[b], vertices)) {
        return std::move(*corners);
      }
      add_neighbours(around);
    }
    return {};
  }

  void add_neighbours(std::vector<std::uint32_t>& nodes) const {
    const std::size_t count = nodes.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::uint32_t c : neighbours_[nodes[i]]) {
        nodes.push_back(c);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }

  /// Ways of long edges first, which are those of the largest parts of the surface.
  void sort_ways() {
    const PlaceOrder order(graph_.nodes);
    const auto rank = [&](const Way& way) {
      const auto [a, b] = way.ends;
      return std::tuple(order.steps((graph_.nodes[a] - graph_.nodes[b]).norm()),
                        order.place(graph_.nodes[a], graph_.nodes[b]), way.ends);
    };
    std::sort(ways_.begin(), ways_.end(),
              [&](const Way& x, const Way& y) { return rank(y) < rank(x); });
  }

  /// Puts nodes at the corners between a and b.
  void lead(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& corners) {
    Way way{{a, b}, {}};
    std::uint32_t previous = a;
    for (const Vec3& corner : corners) {
      const auto node = static_cast<std::uint32_t>(graph_.nodes.size());
      graph_.nodes.push_back(corner);
      graph_.edges.push_back({std::min(previous, node), std::max(previous, node)});
      way.corners.push_back(node);
      previous = node;
    }
    graph_.edges.push_back({std::min(previous, b), std::max(previous, b)});
    ways_.push_back(std::move(way));
  }

  /// Gives the vertices of `from` that are nearer to a corner to the nearest of them, but never all
  /// of them.
  void hand_over(std::uint32_t from, const std::vector<std::uint32_t>& corners) {
    std::vector<std::uint32_t> kept;
    std::vector<std::array<std::uint32_t, 2>> given;
    for (const std::uint32_t v : vertices_[from]) {
      const Vec3& p = routing_.mesh.positions[v];
      std::uint32_t nearest = from;
      for (const std::uint32_t node : corners) {
        if ((p - graph_.nodes[node]).squaredNorm() < (p - graph_.nodes[nearest]).squaredNorm()) {
          nearest = node;
        }
      }
      if (nearest == from) {
        kept.push_back(v);
      } else {
        given.push_back({v, nearest});
      }
    }
    if (kept.empty()) {
      return;
    }
    for (const auto& [v, node] : given) {
      node_of_vertex_[v] = node;
    }
    vertices_[from] = std::move(kept);
  }

  CurveGraph graph_;
  const Routing& routing_;
  std::vector<std::uint32_t>& node_of_vertex_;
  std::vector<std::uint32_t> component_;  ///< Of the nodes that were there at the start.
  std::vector<std::vector<std::uint32_t>> vertices_;
  IndexLists neighbours_;  ///< Before any was put in between.
  std::vector<Way> ways_{};
  std::optional<InteriorPaths> paths_{};
};

}  // namespace

std::vector<std::uint32_t> components_of_nodes(const CurveGraph& graph,
                                               std::span<const std::uint32_t> node_of_vertex,
                                               std::span<const std::uint32_t> component_of_vertex) {
  DisjointSets sets(graph.nodes.size());
  for (const auto& [a, b] : graph.edges) {
    sets.join(a, b);
  }
  std::vector<std::uint32_t> component(graph.nodes.size(), Skeleton::kNone);
  for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
    if (node_of_vertex[v] != Skeleton::kNone) {
      component[sets.root(node_of_vertex[v])] = component_of_vertex[v];
    }
  }
  for (std::uint32_t i = 0; i < component.size(); ++i) {
    component[i] = component[sets.root(i)];
  }
  return component;
}

CurveGraph move_nodes_inside(const CurveGraph& centred, const CurveGraph& raw,
                             const Routing& routing,
                             std::span<const std::uint32_t> node_of_vertex) {
  CurveGraph graph = centred;
  const auto vertices = vertices_of_nodes(graph.nodes.size(), node_of_vertex);
  const auto components = components_of_nodes(graph, node_of_vertex, routing.component_of_vertex);
  std::vector<std::uint32_t> outside;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    routing.run.check();
    const std::uint32_t component = components[i];
    if (component == Skeleton::kNone) {
      continue;
    }
    const Vec3 half_way = 0.5 * (centred.nodes[i] + raw.nodes[i]);
    const std::array places{centred.nodes[i], half_way, raw.nodes[i]};
    const auto* const place = std::find_if(places.begin(), places.end(), [&](const Vec3& p) {
      return routing.shell.well_inside(component, p);
    });
    if (place != places.end()) {
      graph.nodes[i] = *place;
    } else {
      outside.push_back(i);
    }
  }
  const auto neighbours = node_neighbours(graph);
  WallMiddles walls(std::move(graph), routing.shell);
  for (const std::uint32_t i : outside) {
    routing.run.check();
    if (!walls.add(i, vertices[i])) {
      for (const std::uint32_t c : neighbours[i]) {
        walls.add(i, vertices[c]);
      }
    }
  }
  return walls.move();
}

CurveGraph route_edges_inside(CurveGraph graph, const Routing& routing,
                              std::vector<std::uint32_t>& node_of_vertex) {
  EdgeRouter router(std::move(graph), routing, node_of_vertex);
  return router.route();
}

}  // namespace vantage
