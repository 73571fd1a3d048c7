// SPDX-License-Identifier: MIT
#include "skeleton/embedding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/skeleton/skeleton.h"

#include "core/random.h"

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

/// Cuts as prune_ends() does, by the letter: looks at all ends anew for each that is cut.
Pruned pruned_by_the_letter(const CurveGraph& graph, const std::vector<double>& radius) {
  const IndexLists flat = node_neighbours(graph);
  std::vector<std::vector<std::uint32_t>> lists;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    lists.emplace_back(flat[i].begin(), flat[i].end());
  }
  std::vector<std::uint32_t> stands_for(graph.nodes.size());
  std::iota(stands_for.begin(), stands_for.end(), 0U);
  for (;;) {
    double shortest = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> best;  // its nodes, then the junction
    for (std::uint32_t tip = 0; tip < lists.size(); ++tip) {
      std::vector<std::uint32_t> way{tip};
      double length = 0.0;
      for (std::size_t left = 1; lists[tip].size() == 1 && left == 1;) {
        const std::uint32_t from = way.size() > 1 ? way[way.size() - 2] : Skeleton::kNone;
        const auto& around = lists[way.back()];
        const std::uint32_t next = around.front() != from ? around.front() : around.back();
        length += (graph.nodes[next] - graph.nodes[way.back()]).norm();
        way.push_back(next);
        left = lists[next].size() - 1;
      }
      if (way.size() > 1 && lists[way.back()].size() > 2 && length < radius[way.back()] &&
          length < shortest) {
        shortest = length;
        best = way;
      }
    }
    if (best.empty()) {
      break;
    }
    const std::uint32_t junction = best.back();
    best.pop_back();
    std::erase(lists[junction], best.back());
    for (const std::uint32_t node : best) {
      lists[node].clear();
      stands_for[node] = junction;
    }
  }
  Pruned result;
  for (std::uint32_t i = 0; i < stands_for.size(); ++i) {
    result.node_of_vertex.push_back(i);
  }
  result.graph = without_merged(graph, stands_for, result.node_of_vertex);
  return result;
}

/// A graph to prune, and the radii of its nodes.
struct Prunable {
  CurveGraph graph{};
  std::vector<double> radius{};
};

/// A tree on a grid, so that many of its ends are equally long, with a cycle on a stalk.
/// \param reach how many nodes before it a node may hang from.
Prunable random_tree(std::uint32_t reach, Pcg32& random) {
  Prunable made;
  auto& [graph, radius] = made;
  const auto count = static_cast<std::uint32_t>(random.below(60) + 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    graph.nodes.emplace_back(static_cast<double>(random.below(4)),
                             static_cast<double>(random.below(4)), 0.0);
    radius.push_back(static_cast<double>(random.below(8)));
    if (i > 0) {
      const auto back = static_cast<std::uint32_t>(random.below(std::min(i, reach)));
      graph.edges.push_back({i - 1 - back, i});
    }
  }
  graph.edges.push_back({count - 1, count});
  for (std::uint32_t i = count; i < count + 3; ++i) {
    graph.nodes.emplace_back(0.5, 0.5, static_cast<double>(i));
    radius.push_back(1.0);
  }
  for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(1U, 2U), std::pair(0U, 2U)}) {
    graph.edges.push_back({count + a, count + b});
  }
  return made;
}

TEST(PruneEnds, CutsWhatLookingAtAllEndsAnewWouldCut) {
  Pcg32 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const auto [graph, radius] = random_tree(trial % 2 == 0 ? 60 : 3, random);
    const Pruned expected = pruned_by_the_letter(graph, radius);
    std::vector<std::uint32_t> node_of_vertex(graph.nodes.size());
    std::iota(node_of_vertex.begin(), node_of_vertex.end(), 0U);
    const CurveGraph pruned = prune_ends(graph, 1.0, radius, node_of_vertex);
    EXPECT_EQ(pruned.nodes, expected.graph.nodes) << trial;
    EXPECT_EQ(pruned.edges, expected.graph.edges) << trial;
    EXPECT_EQ(node_of_vertex, expected.node_of_vertex) << trial;
  }
}

/// Nodes in a row, each with a tooth that is longer by more than a step than the one before.
TEST(PruneEnds, LooksAtEachEdgeOfACombAFewTimes) {
  constexpr std::uint32_t kTeeth = 50'000;
  CurveGraph comb;
  for (std::uint32_t i = 0; i < kTeeth; ++i) {
    comb.nodes.emplace_back(i, 0.0, 0.0);
    comb.nodes.emplace_back(i, 2.0 * i + 1.0, 0.0);
    comb.edges.push_back({2 * i, 2 * i + 1});
    if (i > 0) {
      comb.edges.push_back({2 * i - 2, 2 * i});
    }
  }
  const Pruned pruned = prune(comb, 1.0, 4.0 * kTeeth);
  EXPECT_EQ(pruned.graph.edges.size() + 1, pruned.graph.nodes.size());
  EXPECT_EQ(pruned.graph.edges.size(), 3U);  // the last tooth, the last step and the tooth before
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
