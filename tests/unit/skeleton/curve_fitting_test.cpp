// SPDX-License-Identifier: MIT
#include "skeleton/curve_fitting.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "spatial/graph_distance.h"
#include "support/worst.h"

namespace vantage {
namespace {

/// Points on an arc of radius 1, from angle 0 to 2.
std::vector<Vec3> arc() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) {
    points.emplace_back(std::cos(0.005 * i), std::sin(0.005 * i), 0.0);
  }
  return points;
}

/// Chords of the arc, at angles 0.2, 1 and 1.8, and the node nearest to each of its points.
const CurveGraph kChords{{{std::cos(0.2), std::sin(0.2), 0},
                          {std::cos(1.0), std::sin(1.0), 0},
                          {std::cos(1.8), std::sin(1.8), 0}},
                         {{0, 1}, {1, 2}}};

std::vector<std::uint32_t> nodes_of_arc() {
  std::vector<std::uint32_t> nodes;
  for (int i = 0; i <= 400; ++i) {
    nodes.push_back(i < 120 ? 0 : i < 280 ? 1 : 2);
  }
  return nodes;
}

double farthest(const CurveGraph& graph) {
  const GraphDistance distance(graph);
  double farthest = 0.0;
  for (const Vec3& p : arc()) {
    farthest = test::larger(farthest, distance(p));
  }
  return farthest;
}

CurveGraph fitted(double piece) {
  return fit_curve(kChords, arc(), std::vector<double>(401, 1.0), nodes_of_arc(), piece);
}

TEST(FitCurve, FollowsThePointsBetweenTheNodesAndBeyondTheEnds) {
  EXPECT_GT(farthest(kChords), 0.07);  // the sagitta of a chord, and 0.2 beyond an end
  EXPECT_LT(farthest(fitted(0.1)), 0.01);
}

TEST(FitCurve, KeepsNodesAndTopology) {
  const CurveGraph fine = fitted(0.1);
  EXPECT_EQ(component_count(fine), 1U);
  EXPECT_EQ(cycle_count(fine), 0U);
  EXPECT_EQ(node_degrees(fine)[0], 1U);
  EXPECT_EQ(node_degrees(fine)[1], 2U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE((fine.nodes[i] - kChords.nodes[i]).norm(), 0.25);
  }
}

TEST(FitCurve, LeavesANodeWithoutPointsBetweenItsNeighbours) {
  const CurveGraph path{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1}, {1, 2}}};
  const std::vector<Vec3> ends{{0, 0, 0}, {2, 0, 0}};
  const CurveGraph fine =
      fit_curve(path, ends, std::vector<double>{1, 1}, std::vector<std::uint32_t>{0, 2}, 10.0);
  ASSERT_EQ(fine.nodes.size(), 3U);
  EXPECT_LE((fine.nodes[1] - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(FitCurve, LeavesOutPointsOfNoNode) {
  const CurveGraph node{{{0, 0, 0}}, {}};
  const CurveGraph fine =
      fit_curve(node, std::vector<Vec3>{{1, 0, 0}, {9, 0, 0}}, std::vector<double>{1, 1},
                std::vector<std::uint32_t>{0, 0xffffffffu}, 0.1);
  EXPECT_LE((fine.nodes[0] - Vec3(1, 0, 0)).norm(), 1e-12);
}

/// As the graph of a model of many needles, each of them as long as the model.
TEST(FitCurve, MakesFewPiecesWhereFewPointsSpanLongEdges) {
  CurveGraph needles;
  std::vector<std::uint32_t> node_of_point;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    needles.nodes.emplace_back(0.0, i, 0.0);
    needles.nodes.emplace_back(1000.0, i, 0.0);
    needles.edges.push_back({2 * i, 2 * i + 1});
    node_of_point.push_back(2 * i);
    node_of_point.push_back(2 * i + 1);
  }
  const CurveGraph fine =
      fit_curve(needles, needles.nodes, std::vector<double>(6000, 1.0), node_of_point, 1.0);
  EXPECT_LT(fine.nodes.size(), 110'000U);
  EXPECT_GT(fine.nodes.size(), 90'000U);
  EXPECT_EQ(component_count(fine), 3000U);
}

}  // namespace
}  // namespace vantage
