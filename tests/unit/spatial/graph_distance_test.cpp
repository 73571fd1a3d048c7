// SPDX-License-Identifier: MIT
#include "spatial/graph_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/dense_oracles.h"
#include "support/worst.h"

namespace vantage {
namespace {

// Both sides round in double: a few units in the last place of coordinates of order one.
constexpr double kRounding = 1e-14;

Vec3 random_point(Pcg32& random, double size) {
  const double x = random.uniform();
  const double y = random.uniform();
  const double z = random.uniform();
  return size * Vec3(x - 0.5, y - 0.5, z - 0.5);
}

/// Random nodes and edges: with fewer edges than nodes some nodes stay alone.
CurveGraph random_graph(Pcg32& random, std::uint32_t nodes, std::uint32_t edges) {
  CurveGraph graph;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    graph.nodes.push_back(random_point(random, 1.0));
  }
  for (std::uint32_t i = 0; i < edges; ++i) {
    const std::uint32_t a = random.below(nodes);
    const std::uint32_t b = random.below(nodes);
    if (a != b) {
      graph.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  return graph;
}

double worst_error(const CurveGraph& graph, Pcg32& random, int queries) {
  const GraphDistance distance(graph);
  double worst = 0.0;
  for (int q = 0; q < queries; ++q) {
    const Vec3 point = random_point(random, q % 2 == 0 ? 1.0 : 10.0);
    worst =
        test::larger(worst, std::abs(distance(point) - test::brute_force_distance(graph, point)));
  }
  return worst;
}

TEST(GraphDistance, AgreesWithBruteForceWhereManyLongSegmentsAreCut) {
  Pcg32 random(11);
  const CurveGraph graph = random_graph(random, 1000, 3000);
  EXPECT_LT(worst_error(graph, random, 500), 10.0 * kRounding);
}

TEST(GraphDistance, AgreesWithBruteForceOnRandomGraphs) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    Pcg32 random(seed);
    const CurveGraph graph = random_graph(random, 200, 300);
    EXPECT_LT(worst_error(graph, random, 500), 10.0 * kRounding) << "seed " << seed;
  }
}

TEST(GraphDistance, CountsNodesWithoutEdges) {
  Pcg32 random(7);
  const CurveGraph graph = random_graph(random, 100, 20);
  EXPECT_LT(worst_error(graph, random, 500), 10.0 * kRounding);
}

TEST(GraphDistance, OfASingleNodeIsTheDistanceOfPoints) {
  CurveGraph graph;
  graph.nodes = {Vec3(1.0, 2.0, 3.0)};
  EXPECT_DOUBLE_EQ(GraphDistance(graph)(Vec3(1.0 + 2.0, 2.0 - 3.0, 3.0 + 6.0)), 7.0);
}

TEST(GraphDistance, ToTheMiddleOfAnEdgeIsThePerpendicular) {
  CurveGraph graph;
  graph.nodes = {Vec3(-4.0, 0.0, 0.0), Vec3(4.0, 0.0, 0.0)};
  graph.edges = {{0, 1}};
  EXPECT_DOUBLE_EQ(GraphDistance(graph)(Vec3(1.0, 3.0, 4.0)), 5.0);
}

TEST(GraphDistance, BeyondTheEndOfAnEdgeIsTheDistanceToItsNode) {
  CurveGraph graph;
  graph.nodes = {Vec3(-4.0, 0.0, 0.0), Vec3(4.0, 0.0, 0.0)};
  graph.edges = {{0, 1}};
  EXPECT_DOUBLE_EQ(GraphDistance(graph)(Vec3(4.0 + 3.0, 4.0, 0.0)), 5.0);
}

TEST(GraphDistance, TakesAnEdgeOfNoLengthForItsPoint) {
  CurveGraph graph;
  graph.nodes = {Vec3(1.0, 1.0, 1.0), Vec3(1.0, 1.0, 1.0)};
  graph.edges = {{0, 1}};
  EXPECT_DOUBLE_EQ(GraphDistance(graph)(Vec3(1.0, 1.0, 3.5)), 2.5);
}

TEST(GraphDistance, AgreesWithBruteForceWhereManyNodesShareAPosition) {
  Pcg32 random(11);
  CurveGraph graph = random_graph(random, 60, 90);
  for (std::size_t i = 0; i < graph.nodes.size(); i += 3) {
    graph.nodes[i] = graph.nodes[0];
  }
  EXPECT_LT(worst_error(graph, random, 300), 10.0 * kRounding);
}

TEST(GraphDistance, IsZeroOnEveryNode) {
  Pcg32 random(13);
  const CurveGraph graph = random_graph(random, 80, 40);
  const GraphDistance distance(graph);
  double worst = 0.0;
  for (const Vec3& node : graph.nodes) {
    worst = test::larger(worst, distance(node));
  }
  EXPECT_LT(worst, kRounding);
}

}  // namespace
}  // namespace vantage
