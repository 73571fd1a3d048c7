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

/// A torus that belongs to one node but for two thin slices across from it: the ways to both lead
/// below the same vertices. \param first node of the slice at 9°; `second` is that at 27°. \return the
/// node of every vertex, then all nodes in the order of their coordinates.
std::vector<Vec3> routed_slices(std::uint32_t first, std::uint32_t second, std::uint32_t rest) {
  Quarters q;
  std::fill(q.node_of_vertex.begin(), q.node_of_vertex.end(), rest);
  std::fill_n(q.node_of_vertex.begin() + 12, 12, first);
  std::fill_n(q.node_of_vertex.begin() + 36, 12, second);
  q.graph.nodes.resize(3);
  q.graph.nodes[first] = Vec3(std::cos(0.157), std::sin(0.157), 0.0);
  q.graph.nodes[second] = Vec3(std::cos(0.471), std::sin(0.471), 0.0);
  q.graph.nodes[rest] = Vec3(-1.0, 0.0, 0.0);
  q.graph.edges = {{std::min(first, rest), std::max(first, rest)},
                   {std::min(second, rest), std::max(second, rest)}};
  std::sort(q.graph.edges.begin(), q.graph.edges.end());
  CurveGraph routed = route_edges_inside(q.graph, q.routing, q.node_of_vertex);
  std::vector<Vec3> places;
  for (const std::uint32_t node : q.node_of_vertex) {
    places.push_back(routed.nodes[node]);
  }
  std::sort(routed.nodes.begin(), routed.nodes.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  places.insert(places.end(), routed.nodes.begin(), routed.nodes.end());
  return places;
}

TEST(RouteEdgesInside, TakesTheSameWaysInWhateverOrderEdgesCome) {
  const std::vector<Vec3> routed = routed_slices(1, 2, 0);
  EXPECT_GT(routed.size(), Quarters().node_of_vertex.size() + 3);
  EXPECT_EQ(routed_slices(2, 1, 0), routed);
  EXPECT_EQ(routed_slices(0, 1, 2), routed);
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
