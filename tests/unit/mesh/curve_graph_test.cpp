// SPDX-License-Identifier: MIT
#include "vantage/mesh/curve_graph.h"

#include <gtest/gtest.h>

namespace vantage {
namespace {

CurveGraph square_with_tail_and_loner() {
  return {.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 0, 0}, {9, 9, 9}},
          .edges = {{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 3}}};
}

TEST(SmoothedAlongChains, MovesNodesInsideChainsAlone) {
  const CurveGraph graph{{{0, 0, 0}, {1, 4, 0}, {2, 0, 0}, {2, 0, 8}, {2, 0, -8}},
                         {{0, 1}, {1, 2}, {2, 3}, {2, 4}}};
  std::vector<Vec3> expected = graph.nodes;
  expected[1] = {1, 2, 0};  // ½ of its own, ¼ of both others; ends and the junction stay
  EXPECT_EQ(smoothed_along_chains(graph.nodes, node_neighbours(graph)), expected);
}

TEST(CurveGraphCounts, AnIsolatedNodeIsAComponent) {
  EXPECT_EQ(component_count(square_with_tail_and_loner()), 2U);
}

TEST(CurveGraphCounts, ASquareHasOneCycleWhateverHangsFromIt) {
  EXPECT_EQ(cycle_count(square_with_tail_and_loner()), 1U);
}

TEST(CurveGraphCounts, TheCompleteGraphOfFourNodesHasThreeIndependentCycles) {
  const CurveGraph graph{.nodes = std::vector<Vec3>(4, Vec3::Zero()),
                         .edges = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  EXPECT_EQ(cycle_count(graph), 6U - 4U + 1U);
}

TEST(CurveGraphCounts, TheEmptyGraphHasNothing) {
  EXPECT_EQ(component_count({}), 0U);
  EXPECT_EQ(cycle_count({}), 0U);
}

TEST(TotalLength, AddsUpTheEdges) {
  EXPECT_DOUBLE_EQ(total_length(square_with_tail_and_loner()), 4.0 * 1.0 + 2.0);
}

using Runs = std::vector<std::vector<std::uint32_t>>;

TEST(GraphBranches, RunBetweenEndsAndJunctions) {
  // A path 0-1-2 into a junction with two ends, one of them two edges away.
  const CurveGraph graph{std::vector<Vec3>(6, Vec3::Zero()),
                         {{0, 1}, {1, 2}, {2, 3}, {2, 4}, {4, 5}}};
  EXPECT_EQ(graph_branches(graph), (Runs{{0, 1, 2}, {2, 3}, {2, 4, 5}}));
}

TEST(GraphBranches, GoOnceAroundAPlainLoop) {
  const CurveGraph graph{std::vector<Vec3>(3, Vec3::Zero()), {{0, 1}, {0, 2}, {1, 2}}};
  EXPECT_EQ(graph_branches(graph), (Runs{{0, 1, 2, 0}}));
}

TEST(GraphBranches, ComeBackToAJunctionWithALoop) {
  const CurveGraph graph{std::vector<Vec3>(4, Vec3::Zero()), {{0, 1}, {1, 2}, {1, 3}, {2, 3}}};
  EXPECT_EQ(graph_branches(graph), (Runs{{0, 1}, {1, 2, 3, 1}}));
}

TEST(GraphBranches, LeaveOutLonelyNodes) {
  EXPECT_TRUE(graph_branches({{Vec3::Zero()}, {}}).empty());
}

TEST(NodeDegrees, CountEdges) {
  const CurveGraph graph{std::vector<Vec3>(4, Vec3::Zero()), {{0, 1}, {1, 2}}};
  EXPECT_EQ(node_degrees(graph), (std::vector<std::uint32_t>{1, 2, 1, 0}));
}

}  // namespace
}  // namespace vantage
