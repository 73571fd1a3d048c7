// SPDX-License-Identifier: MIT
#include "skeleton/routing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/dense_oracles.h"
#include "support/shapes.h"
#include "support/skeletons.h"

namespace vantage {
namespace {

/// A torus of 40 × 12 vertices, cut into four quarters, each with a node.
struct Quarters {
  TriMesh mesh = test::torus(1.0, 0.2, 40, 12);
  std::vector<std::uint32_t> component_of_vertex = test::one_component(mesh);
  Shell shell{mesh, component_of_vertex};
  Routing routing{mesh, component_of_vertex, shell};
  std::vector<std::uint32_t> node_of_vertex{};
  CurveGraph graph{.nodes = {}, .edges = {{0, 1}, {0, 3}, {1, 2}, {2, 3}}};

  Quarters() {
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      node_of_vertex.push_back(v / 120);
    }
    for (int q = 0; q < 4; ++q) {
      const double angle = (q + 0.5) * 0.5 * 3.14159265358979;
      graph.nodes.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
  }
};

TEST(MoveNodesInside, LeavesNodesInsideAlone) {
  const Quarters q;
  EXPECT_EQ(move_nodes_inside(q.graph, q.graph, q.routing, q.node_of_vertex).nodes, q.graph.nodes);
}

TEST(MoveNodesInside, GoesBackTowardsTheRawPlaceIfThatIsInside) {
  const Quarters q;
  CurveGraph centred = q.graph;
  centred.nodes[0] = Vec3::Zero();  // in the hole
  const CurveGraph moved = move_nodes_inside(centred, q.graph, q.routing, q.node_of_vertex);
  EXPECT_EQ(moved.nodes[0], q.graph.nodes[0]);
}

TEST(MoveNodesInside, FindsTheMiddleOfTheWallIfNeitherPlaceIsInside) {
  const Quarters q;
  CurveGraph centred = q.graph;
  centred.nodes[0] = Vec3(0.1, 0.1, 0.0);
  const CurveGraph moved = move_nodes_inside(centred, centred, q.routing, q.node_of_vertex);
  EXPECT_NEAR(test::winding_number(q.mesh, moved.nodes[0]), 1.0, 1e-9);
  EXPECT_NEAR(std::hypot(moved.nodes[0].x(), moved.nodes[0].y()), 1.0, 0.1);
}

TEST(RouteEdgesInside, BendsChordsAroundTheHole) {
  Quarters q;
  const CurveGraph routed = route_edges_inside(q.graph, q.routing, q.node_of_vertex);
  EXPECT_GT(routed.nodes.size(), 4U);
  EXPECT_EQ(cycle_count(routed), 1U);
  EXPECT_EQ(component_count(routed), 1U);
  for (const auto& [a, b] : routed.edges) {
    EXPECT_TRUE(q.shell.inside(0, routed.nodes[a], routed.nodes[b]));
  }
}

TEST(RouteEdgesInside, GivesTheNewNodesTheVerticesNearThem) {
  Quarters q;
  const CurveGraph routed = route_edges_inside(q.graph, q.routing, q.node_of_vertex);
  std::vector<int> vertices(routed.nodes.size(), 0);
  for (const std::uint32_t node : q.node_of_vertex) {
    ASSERT_LT(node, routed.nodes.size());
    ++vertices[node];
  }
  for (const int count : vertices) {
    EXPECT_GT(count, 0);
  }
}

TEST(RouteEdgesInside, TakesTheSameWaysInWhateverOrderEdgesCome) {
  Quarters q;
  const CurveGraph routed = route_edges_inside(q.graph, q.routing, q.node_of_vertex);
  Quarters other;
  std::reverse(other.graph.nodes.begin(), other.graph.nodes.end());
  for (std::uint32_t& node : other.node_of_vertex) {
    node = 3 - node;
  }
  const CurveGraph again = route_edges_inside(other.graph, other.routing, other.node_of_vertex);
  const auto sorted = [](std::vector<Vec3> nodes) {
    std::sort(nodes.begin(), nodes.end(), [](const Vec3& a, const Vec3& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    return nodes;
  };
  EXPECT_EQ(sorted(again.nodes), sorted(routed.nodes));
  for (std::size_t v = 0; v < q.node_of_vertex.size(); ++v) {
    EXPECT_EQ(again.nodes[other.node_of_vertex[v]], routed.nodes[q.node_of_vertex[v]]) << v;
  }
}

TEST(MoveNodesInside, LeavesNothingOnTheSurface) {
  const Quarters q;
  CurveGraph centred = q.graph;
  centred.nodes[0] = q.mesh.positions[60];
  const CurveGraph moved = move_nodes_inside(centred, centred, q.routing, q.node_of_vertex);
  EXPECT_TRUE(q.shell.well_inside(0, moved.nodes[0]));
}

}  // namespace
}  // namespace vantage
