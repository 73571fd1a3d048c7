// SPDX-License-Identifier: MIT
#include "mesh/close_nodes.h"

#include <cmath>
#include <ctime>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/skeleton/skeleton.h"

#include "support/worst.h"

namespace vantage {
namespace {

using ::testing::ElementsAre;

/// A chain along x with nodes every `step`.
CurveGraph chain(std::uint32_t count, double step) {
  CurveGraph graph;
  for (std::uint32_t i = 0; i < count; ++i) {
    graph.nodes.emplace_back(step * i, 0, 0);
    if (i > 0) {
      graph.edges.push_back({i - 1, i});
    }
  }
  return graph;
}

TEST(MergeCloseNodes, LeavesNoPairOfAChainCloserThanTheSpacing) {
  std::vector<std::uint32_t> node_of_vertex;
  const CurveGraph merged =
      merge_close_nodes(chain(101, 0.01), 0.1, std::vector<double>(101, 1.0), node_of_vertex);
  for (const auto& [a, b] : merged.edges) {
    EXPECT_GE((merged.nodes[a] - merged.nodes[b]).norm(), 0.1);
  }
  EXPECT_EQ(merged.edges.size() + 1, merged.nodes.size());
}

TEST(MergeCloseNodes, KeepsEndsWhereTheyAre) {
  std::vector<std::uint32_t> node_of_vertex;
  const CurveGraph merged =
      merge_close_nodes(chain(101, 0.01), 0.1, std::vector<double>(101, 1.0), node_of_vertex);
  double low = 1.0;
  double high = 0.0;
  for (const Vec3& p : merged.nodes) {
    low = test::smaller(low, p.x());
    high = test::larger(high, p.x());
  }
  EXPECT_EQ(low, 0.0);
  EXPECT_EQ(high, 1.0);
}

TEST(MergeCloseNodes, KeepsATinyCycle) {
  const CurveGraph triangle{.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                            .edges = {{0, 1}, {0, 2}, {1, 2}}};
  std::vector<std::uint32_t> node_of_vertex;
  const CurveGraph merged = merge_close_nodes(triangle, 100.0, {1, 1, 1}, node_of_vertex);
  EXPECT_EQ(cycle_count(merged), 1U);
}

TEST(MergeCloseNodes, MapsVerticesAndLeavesIsolatedOnesOut) {
  std::vector<std::uint32_t> node_of_vertex{0, 1, 2, Skeleton::kNone};
  const CurveGraph merged =
      merge_close_nodes({.nodes = {{0, 0, 0}, {0.1, 0, 0}, {5, 0, 0}}, .edges = {{0, 1}, {1, 2}}},
                        1.0, {1, 1, 1}, node_of_vertex);
  EXPECT_EQ(merged.nodes.size(), 2U);
  EXPECT_THAT(node_of_vertex, ElementsAre(0U, 0U, 1U, Skeleton::kNone));
}

TEST(MergeCloseNodes, StaysFiniteForNodesThatStandForNoVertex) {
  std::vector<std::uint32_t> node_of_vertex;
  const CurveGraph merged =
      merge_close_nodes(chain(8, 0.1), 0.25, {1, 1, 0, 0, 0, 0, 1, 1}, node_of_vertex);
  for (const Vec3& p : merged.nodes) {
    EXPECT_TRUE(p.allFinite());
  }
}

TEST(MergeCloseNodes, OfTwoJunctionsKeepsThatOfMoreVerticesHoweverNodesAreNumbered) {
  const CurveGraph graph{
      .nodes = {{0, 0, 0}, {0.1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {1, -1, 0}},
      .edges = {{0, 1}, {0, 2}, {0, 3}, {1, 4}, {1, 5}}};
  std::vector<std::uint32_t> node_of_vertex;
  const CurveGraph first = merge_close_nodes(graph, 0.5, {9, 5, 1, 1, 1, 1}, node_of_vertex);
  const CurveGraph second = merge_close_nodes(graph, 0.5, {5, 9, 1, 1, 1, 1}, node_of_vertex);
  EXPECT_EQ(first.nodes[0], Vec3(0, 0, 0));
  EXPECT_EQ(second.nodes[0], Vec3(0.1, 0, 0));
}

TEST(MergeCloseNodes, EndsSoonAtAHubOfThousandsOfShortChains) {
  constexpr std::uint32_t kChains = 3000;
  CurveGraph hub{{Vec3::Zero()}, {}};
  for (std::uint32_t i = 0; i < kChains; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kChains;
    const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
    hub.nodes.emplace_back((0.01 + 1e-6 * i) * along);
    hub.nodes.emplace_back(along);
    hub.edges.push_back({0, 2 * i + 1});
    hub.edges.push_back({2 * i + 1, 2 * i + 2});
  }
  std::vector<std::uint32_t> node_of_vertex;
  const std::clock_t begin = std::clock();
  const CurveGraph merged =
      merge_close_nodes(hub, 0.1, std::vector<double>(hub.nodes.size(), 1.0), node_of_vertex);
  // Some hundredths of a second; where each merge offers all of the hub's edges anew, several seconds.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 1.0);
  EXPECT_EQ(merged.edges.size(), kChains);
}

}  // namespace
}  // namespace vantage
