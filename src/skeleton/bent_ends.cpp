// SPDX-License-Identifier: MIT
#include "skeleton/bent_ends.h"

#include <numbers>
#include <optional>

#include "vantage/mesh/measures.h"
#include "vantage/skeleton/skeleton.h"

#include "skeleton/embedding.h"

namespace vantage {
namespace {

// Cosines: a tip further than 45° off the way to it bends aside; a middle within 30° of the way there is
// straight ahead. A foot's is not, that of a lamp's base is. [ours, by looking]
constexpr double kBent = 0.5 * std::numbers::sqrt2;
constexpr double kAhead = 0.5 * std::numbers::sqrt3;

double cosine(const Vec3& a, const Vec3& b) {
  return a.dot(b) / (a.norm() * b.norm());
}

/// The last nodes of a chain: its tip, the one before, and two before that or the same one twice.
struct ChainEnd {
  std::uint32_t tip, root, before, way;
};

/// The end of a plain chain of at least three nodes that do not end on the other side at once.
std::optional<ChainEnd> chain_end(std::uint32_t tip, const IndexLists& neighbours) {
  const auto beyond = [&](std::uint32_t node, std::uint32_t from) {
    return neighbours[node][neighbours[node][0] == from ? 1 : 0];
  };
  if (neighbours[tip].size() != 1 || neighbours[neighbours[tip][0]].size() != 2) {
    return std::nullopt;
  }
  ChainEnd end{tip, neighbours[tip][0], 0, 0};
  end.before = beyond(end.root, tip);
  if (neighbours[end.before].size() < 2) {
    return std::nullopt;  // no way to bend from
  }
  end.way = neighbours[end.before].size() == 2 ? beyond(end.before, end.root) : end.before;
  return end;
}

/// The area-weighted mean of the vertices of two nodes.
class Middles {
 public:
  Middles(const TriMesh& mesh, std::size_t nodes, const std::vector<std::uint32_t>& node_of_vertex)
      : sum_(nodes, Vec3::Zero()), weight_(nodes, 0.0) {
    const std::vector<double> areas = vertex_areas(mesh);
    for (std::size_t v = 0; v < node_of_vertex.size(); ++v) {
      if (node_of_vertex[v] != Skeleton::kNone) {
        sum_[node_of_vertex[v]] += areas[v] * mesh.positions[v];
        weight_[node_of_vertex[v]] += areas[v];
      }
    }
  }

  /// \return NaN where neither has an area.
  [[nodiscard]] Vec3 of(std::uint32_t one, std::uint32_t other) const {
    return (sum_[one] + sum_[other]) / (weight_[one] + weight_[other]);
  }

 private:
  std::vector<Vec3> sum_;
  std::vector<double> weight_;
};

}  // namespace

CurveGraph take_in_bent_ends(const CurveGraph& graph, double ratio, const Routing& routing,
                             std::vector<std::uint32_t>& node_of_vertex) {
  const auto neighbours = node_neighbours(graph);
  const std::vector<double> radius = node_radii(graph, routing.mesh, node_of_vertex);
  const Middles middles(routing.mesh, graph.nodes.size(), node_of_vertex);
  const auto component = components_of_nodes(graph, node_of_vertex, routing.component_of_vertex);
  CurveGraph straight = graph;
  std::vector<std::uint32_t> stands_for(graph.nodes.size());
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    stands_for[i] = i;
  }
  const auto bends_aside = [&](const ChainEnd& end) {
    const Vec3 in = graph.nodes[end.root] - graph.nodes[end.before];
    const Vec3 out = graph.nodes[end.tip] - graph.nodes[end.root];
    return cosine(in, out) < kBent && out.norm() < ratio * radius[end.root];
  };
  const auto is_ahead = [&](const ChainEnd& end, const Vec3& place) {
    const Vec3& before = graph.nodes[end.before];
    const Vec3 way =
        end.way == end.before ? graph.nodes[end.root] - before : before - graph.nodes[end.way];
    return cosine(way, place - before) > kAhead &&
           routing.shell.well_inside(component[end.root], place);
  };
  for (std::uint32_t tip = 0; tip < graph.nodes.size(); ++tip) {
    const std::optional<ChainEnd> end = chain_end(tip, neighbours);
    if (!end || component[end->root] == Skeleton::kNone || !bends_aside(*end)) {
      continue;
    }
    const Vec3 middle = middles.of(tip, end->root);
    if (is_ahead(*end, middle)) {
      stands_for[tip] = end->root;
      straight.nodes[end->root] = middle;
    }
  }
  return without_merged(straight, stands_for, node_of_vertex);
}

}  // namespace vantage
