// SPDX-License-Identifier: MIT
#include "skeleton/embedding.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/skeleton/skeleton.h"

namespace vantage {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;

/// A path 0–1–2–3–4 along x with unit steps, and a side branch 2–5–6 of length 0.6.
CurveGraph path_with_branch() {
  return {{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(2.0, 0.0, 0.0), Vec3(3.0, 0.0, 0.0),
           Vec3(4.0, 0.0, 0.0), Vec3(2.0, 0.3, 0.0), Vec3(2.0, 0.6, 0.0)},
          Edges{{0, 1}, {1, 2}, {2, 3}, {2, 5}, {3, 4}, {5, 6}}};
}

struct Pruned {
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};
};

/// One vertex a node, and a last one that belongs to none.
Pruned prune(const CurveGraph& graph, double ratio, double thickness) {
  Pruned result;
  const std::vector<double> radius(graph.nodes.size(), thickness);
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    result.node_of_vertex.push_back(i);
  }
  result.node_of_vertex.push_back(Skeleton::kNone);
  result.graph = prune_ends(graph, ratio, radius, result.node_of_vertex);
  return result;
}

TEST(PruneEnds, CutsABranchShorterThanItsRootIsThick) {
  const Pruned pruned = prune(path_with_branch(), 1.0, 0.61);
  EXPECT_EQ(pruned.graph.edges, (Edges{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(pruned.graph.nodes.size(), 5U);
}

TEST(PruneEnds, KeepsABranchLongerThanItsRootIsThick) {
  EXPECT_EQ(prune(path_with_branch(), 1.0, 0.59).graph.edges, path_with_branch().edges);
}

TEST(PruneEnds, ComparesWithTheRatioTimesTheThickness) {
  EXPECT_EQ(prune(path_with_branch(), 0.5, 0.61).graph.edges.size(), 6U);
  EXPECT_EQ(prune(path_with_branch(), 0.5, 1.21).graph.edges.size(), 4U);
}

TEST(PruneEnds, GivesTheVerticesOfABranchToItsJunction) {
  const Pruned pruned = prune(path_with_branch(), 1.0, 0.61);
  EXPECT_EQ(pruned.node_of_vertex,
            (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2, 2, Skeleton::kNone}));
}

TEST(PruneEnds, NeverCutsAPlainPath) {
  const CurveGraph path{{Vec3::Zero(), Vec3::UnitX()}, Edges{{0, 1}}};
  EXPECT_EQ(prune(path, 1.0, 50.0).graph.edges, path.edges);
}

TEST(PruneEnds, OfThreeShortArmsCutsOnlyTheShortest) {
  // When it is gone the other two are one path, with no root to compare with.
  const CurveGraph star{
      {Vec3::Zero(), Vec3(0.3, 0.0, 0.0), Vec3(0.0, 0.2, 0.0), Vec3(0.0, 0.0, 0.4)},
      Edges{{0, 1}, {0, 2}, {0, 3}}};
  const Pruned pruned = prune(star, 1.0, 5.0);
  EXPECT_EQ(pruned.graph.edges, (Edges{{0, 1}, {0, 2}}));
  EXPECT_EQ(pruned.node_of_vertex, (std::vector<std::uint32_t>{0, 1, 0, 2, Skeleton::kNone}));
}

TEST(PruneEnds, KeepsACycleWhoseOnlyEndIsCut) {
  const CurveGraph lollipop{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3(-0.1, 0.0, 0.0)},
                            Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}}};
  EXPECT_EQ(prune(lollipop, 1.0, 9.0).graph.edges, (Edges{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(PruneEnds, FollowsVerticesThroughAJunctionThatIsCutLater) {
  // A fork (5–6 and 5–7) at the end of a branch: first 7 goes to 5, then 5 and 6 go to 2.
  CurveGraph graph = path_with_branch();
  graph.nodes.emplace_back(2.1, 0.3, 0.0);
  graph.edges = {{0, 1}, {1, 2}, {2, 3}, {2, 5}, {3, 4}, {5, 6}, {5, 7}};
  const Pruned pruned = prune(graph, 1.0, 0.7);
  EXPECT_EQ(pruned.node_of_vertex,
            (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2, 2, 2, Skeleton::kNone}));
}

/// Two nodes of two vertices each, one of no vertex, and an isolated vertex.
struct Standing {
  TriMesh mesh{{Vec3(0.0, 1.0, 0.0), Vec3(0.0, -3.0, 0.0), Vec3(4.0, 2.0, 0.0),
                Vec3(4.0, -2.0, 0.0), Vec3(9.0, 9.0, 9.0)},
               {}};
  CurveGraph graph{{Vec3::Zero(), Vec3(4.0, 0.0, 0.0), Vec3(8.0, 0.0, 0.0)}, Edges{{0, 1}, {1, 2}}};
  std::vector<std::uint32_t> node_of_vertex{0, 0, 1, 1, Skeleton::kNone};
};

TEST(NodeRadii, AreMeanDistancesOrTheNeighboursWithoutVertices) {
  const Standing standing;
  EXPECT_EQ(node_radii(standing.graph, standing.mesh, standing.node_of_vertex),
            (std::vector<double>{(1.0 + 3.0) / 2.0, (2.0 + 2.0) / 2.0, (2.0 + 2.0) / 2.0}));
}

TEST(CentreNodes, MovesAnEndToTheAreaWeightedMeanOfItsVertices) {
  // The right triangles (0, 1, 2) of area 6 and (0, 2, 3) of area 3: vertex 0 has weight 9/3,
  // vertices 1, 2, 3 have 6/3, 9/3, 3/3. Node 0 stands for 0 and 1, node 1 for 2 and 3.
  const TriMesh mesh{{Vec3::Zero(), Vec3(4.0, 0.0, 0.0), Vec3(0.0, 3.0, 0.0), Vec3(-2.0, 0.0, 0.0)},
                     {{0, 1, 2}, {0, 2, 3}}};
  const CurveGraph graph{{Vec3(7.0, 7.0, 7.0), Vec3(8.0, 8.0, 8.0)}, Edges{{0, 1}}};
  const CurveGraph centred = centre_nodes(graph, mesh, std::vector<std::uint32_t>{0, 0, 1, 1});
  const Vec3 first = (3.0 * Vec3::Zero() + 2.0 * Vec3(4.0, 0.0, 0.0)) / 5.0;
  const Vec3 second = (3.0 * Vec3(0.0, 3.0, 0.0) + 1.0 * Vec3(-2.0, 0.0, 0.0)) / 4.0;
  EXPECT_LT((centred.nodes[0] - first).norm(), 1e-14);
  EXPECT_LT((centred.nodes[1] - second).norm(), 1e-14);
}

TEST(CentreNodes, TakesAKinkOutOfAChain) {
  // No vertices, so only the straightening moves: halfway to the middle of the neighbours.
  const CurveGraph graph{{Vec3::Zero(), Vec3(1.0, 1.0, 0.0), Vec3(2.0, 0.0, 0.0)},
                         Edges{{0, 1}, {1, 2}}};
  const CurveGraph centred = centre_nodes(graph, TriMesh{}, {});
  EXPECT_EQ(centred.nodes[1], Vec3(1.0, 0.5, 0.0));
  EXPECT_EQ(centred.nodes[0], graph.nodes[0]);
  EXPECT_EQ(centred.nodes[2], graph.nodes[2]);
}

}  // namespace
}  // namespace vantage
