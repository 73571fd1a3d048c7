// SPDX-License-Identifier: MIT
#include "skeleton/bent_ends.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/skeletons.h"

namespace vantage {
namespace {

/// A cylinder of radius 1 along z up to 9, and a path in it; each node stands for the vertices nearest to its height.
class PathInACylinder {
 public:
  explicit PathInACylinder(std::vector<Vec3> nodes) {
    graph.nodes = std::move(nodes);
    for (std::uint32_t i = 1; i < graph.nodes.size(); ++i) {
      graph.edges.push_back({i - 1, i});
    }
    for (const Vec3& p : mesh.positions) {
      const auto nearest = std::min_element(
          graph.nodes.begin(), graph.nodes.end(), [&](const Vec3& a, const Vec3& b) {
            return std::abs(a.z() - p.z()) < std::abs(b.z() - p.z());
          });
      node_of_vertex.push_back(static_cast<std::uint32_t>(nearest - graph.nodes.begin()));
    }
  }

  void take_in(double ratio) { graph = take_in_bent_ends(graph, ratio, routing, node_of_vertex); }

  TriMesh mesh = test::cylinder(1.0, 9.0, 24, 36);
  std::vector<std::uint32_t> component_of_vertex = test::one_component(mesh);
  Shell shell{mesh, component_of_vertex};
  Routing routing{mesh, component_of_vertex, shell};
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};
};

const std::vector<Vec3> kBent{{0, 0, 1}, {0, 0, 3}, {0, 0, 5}, {0, 0, 7}, {0.6, 0.3, 7.4}};

TEST(TakeInBentEnds, PutsTheNodeBeforeATipInTheMiddleOfBoth) {
  PathInACylinder path(kBent);
  path.take_in(1.0);
  ASSERT_EQ(path.graph.nodes.size(), 4U);
  EXPECT_EQ(path.graph.edges.size(), 3U);
  const Vec3& end = path.graph.nodes[3];
  EXPECT_NEAR(end.x(), 0.0, 1e-9);
  EXPECT_NEAR(end.y(), 0.0, 1e-9);
  EXPECT_GT(end.z(), 7.4);
  EXPECT_LT(end.z(), 9.0);
  EXPECT_EQ(*std::max_element(path.node_of_vertex.begin(), path.node_of_vertex.end()), 3U);
  EXPECT_EQ(path.graph.nodes[0], kBent[0]);
}

TEST(TakeInBentEnds, LeavesTipsThatStickOut) {
  PathInACylinder path(kBent);
  path.take_in(0.5);
  EXPECT_EQ(path.graph.nodes, kBent);
}

TEST(TakeInBentEnds, LeavesStraightEndsAndPathsWithoutADirection) {
  const std::vector<Vec3> straight{{0, 0, 1}, {0, 0, 3}, {0, 0, 7}, {0.3, 0.1, 7.5}};
  PathInACylinder path(straight);
  path.take_in(1.0);
  EXPECT_EQ(path.graph.nodes, straight);
  const std::vector<Vec3> three{{0, 0, 3}, {0, 0, 7}, {0.6, 0.3, 7.4}};
  PathInACylinder corner(three);
  corner.take_in(1.0);
  EXPECT_EQ(corner.graph.nodes, three);
}

}  // namespace
}  // namespace vantage
