// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/skeleton/skeleton.h"

#include "core/random.h"
#include "mesh/close_nodes.h"
#include "skeleton/cluster_complex.h"
#include "skeleton/surgery.h"
#include "support/shapes.h"
#include "unit/skeleton/genus_two.h"

namespace vantage {
namespace {

struct Surface {
  std::string name;
  TriMesh mesh;
  std::size_t components;
  std::size_t genus;
};

std::vector<Surface> surfaces() {
  const TriMesh ring = test::torus(1.0, 0.4, 8, 5);
  const TriMesh double_ring = test::genus_two(8, 5);
  return {{"sphere", test::sphere(2), 1, 0},
          {"smallest_torus", test::torus(1.0, 0.4, 3, 3), 1, 1},
          {"torus", ring, 1, 1},
          {"fat_torus", test::torus(1.0, 0.9, 9, 21), 1, 1},
          {"genus_two", double_ring, 1, 2},
          {"genus_four", test::joined(double_ring, double_ring, 5.9), 1, 4},
          {"two_tori", test::together(ring, ring, Vec3(0.0, 0.0, 3.0)), 2, 2}};
}

ClusterComplex complex_of(const TriMesh& mesh, const std::vector<Vec3>& positions) {
  return {mesh, positions, std::vector<double>(positions.size(), 1.0)};
}

void expect_topology(ClusterComplex& complex, const Surface& surface) {
  const CurveGraph graph = complex.graph().graph;
  EXPECT_EQ(component_count(graph), surface.components);
  EXPECT_EQ(cycle_count(graph), surface.genus);
}

/// Three times the triangles: the triangles at each live edge add up to that.
void expect_consistent_counts(const ClusterComplex& complex) {
  std::size_t sides = 0;
  for (std::uint32_t e = 0; e < complex.edge_count(); ++e) {
    sides += complex.edge_is_live(e) ? complex.faces_at(e) : 0U;
  }
  ASSERT_EQ(sides, 3 * complex.face_count());
}

/// Whether links are sorted without repeats, and their edges join the two clusters.
bool links_are_consistent(ClusterComplex& complex, std::uint32_t cluster) {
  const auto& links = complex.links(cluster);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::uint32_t other = links[i].cluster;
    const std::array expected{std::min(cluster, other), std::max(cluster, other)};
    const bool ascending = i == 0 || links[i - 1].cluster < other;
    if (!ascending || complex.cluster_of(other) != other ||
        complex.ends(links[i].edge) != expected) {
      return false;
    }
  }
  return complex.cluster_of(cluster) == cluster || links.empty();
}

void expect_consistent(ClusterComplex& complex, std::uint32_t clusters) {
  expect_consistent_counts(complex);
  for (std::uint32_t c = 0; c < clusters; ++c) {
    ASSERT_TRUE(links_are_consistent(complex, c)) << "cluster " << c;
  }
}

class SurgeryProperty : public testing::TestWithParam<Surface> {};

TEST_P(SurgeryProperty, KeepsHandlesInWhateverOrderEdgesCollapse) {
  // The guard alone must do it: the order is random, and it is asked before each collapse.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ClusterComplex complex = complex_of(GetParam().mesh, GetParam().mesh.positions);
    Pcg32 random(seed);
    while (complex.face_count() > 0) {
      const std::uint32_t edge = random.below(static_cast<std::uint32_t>(complex.edge_count()));
      if (!complex.edge_is_live(edge) || complex.faces_at(edge) == 0) {
        continue;
      }
      if (!complex.keeps_handles(edge)) {
        complex.make_room(edge);
        ASSERT_TRUE(complex.keeps_handles(edge));
      }
      complex.collapse(edge);
      expect_consistent(complex, static_cast<std::uint32_t>(GetParam().mesh.positions.size()));
    }
    expect_topology(complex, GetParam());
  }
}

TEST_P(SurgeryProperty, KeepsHandlesOfASurfaceShrunkToAPoint) {
  const std::vector<Vec3> point(GetParam().mesh.positions.size(), Vec3(1.0, 2.0, 3.0));
  ClusterComplex complex = complex_of(GetParam().mesh, point);
  EXPECT_EQ(collapse_to_graph(complex, {}), 0U);
  expect_topology(complex, GetParam());
}

TEST_P(SurgeryProperty, KeepsHandlesOfARandomEmbedding) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Pcg32 random(seed, 1);
    std::vector<Vec3> positions;
    for (std::size_t v = 0; v < GetParam().mesh.positions.size(); ++v) {
      const double x = random.uniform();
      const double y = random.uniform();
      positions.emplace_back(x, y, random.uniform());
    }
    ClusterComplex complex = complex_of(GetParam().mesh, positions);
    EXPECT_EQ(collapse_to_graph(complex, {}), 0U);
    expect_topology(complex, GetParam());
  }
}

TEST(Surgery, KeepsMoreHandlesThanClassesOfLoopsFitInAWord) {
  constexpr int kHandles = 33;  // 66 classes
  const TriMesh ring = test::torus(1.0, 0.4, 8, 5);
  TriMesh chain = ring;
  for (int k = 1; k < kHandles; ++k) {
    chain = test::joined(chain, ring, 2.9 * k);
  }
  const std::vector<Vec3> point(chain.positions.size(), Vec3::Zero());
  ClusterComplex complex = complex_of(chain, point);
  EXPECT_EQ(collapse_to_graph(complex, {}), 0U);
  expect_topology(complex, {"chain", chain, 1, kHandles});
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SurgeryProperty, testing::ValuesIn(surfaces()),
                         [](const auto& each) { return each.param.name; });

CurveGraph random_graph(Pcg32& random, std::uint32_t nodes, std::uint32_t tries) {
  CurveGraph graph;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    graph.nodes.emplace_back(x, y, random.uniform());
  }
  std::set<std::array<std::uint32_t, 2>> edges;
  for (std::uint32_t i = 0; i < tries; ++i) {
    const std::uint32_t a = random.below(nodes);
    const std::uint32_t b = random.below(nodes);
    if (a != b) {
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  graph.edges.assign(edges.begin(), edges.end());
  return graph;
}

class MergeCloseNodes : public testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    Pcg32 random(GetParam());
    graph = random_graph(random, 60, 20 + 10 * random.below(8));
    node_of_vertex.resize(graph.nodes.size());
    std::iota(node_of_vertex.begin(), node_of_vertex.end(), 0U);
    node_of_vertex.push_back(Skeleton::kNone);
    merged = merge_close_nodes(graph, kSpacing, std::vector<double>(graph.nodes.size(), 1.0),
                               node_of_vertex);
  }

  static constexpr double kSpacing = 0.5;
  CurveGraph graph{};
  CurveGraph merged{};
  std::vector<std::uint32_t> node_of_vertex{};
};

TEST_P(MergeCloseNodes, KeepsComponentsAndCycles) {
  EXPECT_EQ(component_count(merged), component_count(graph));
  EXPECT_EQ(cycle_count(merged), cycle_count(graph));
}

TEST_P(MergeCloseNodes, LeavesNoShortEdgeThatIsNotPartOfATriangle) {
  for (const auto& [a, b] : merged.edges) {
    if ((merged.nodes[a] - merged.nodes[b]).norm() >= kSpacing) {
      continue;
    }
    std::set<std::uint32_t> beside_a;
    std::set<std::uint32_t> beside_b;
    for (const auto& [c, d] : merged.edges) {
      for (const auto& [from, to] : {std::array{c, d}, std::array{d, c}}) {
        if (from == a) {
          beside_a.insert(to);
        }
        if (from == b) {
          beside_b.insert(to);
        }
      }
    }
    EXPECT_TRUE(std::any_of(beside_a.begin(), beside_a.end(),
                            [&](std::uint32_t c) { return beside_b.count(c) != 0; }))
        << a << "–" << b;
  }
}

TEST_P(MergeCloseNodes, MapsEveryNodeIntoItsOwnComponent) {
  ASSERT_EQ(node_of_vertex.back(), Skeleton::kNone);
  // Joining every old node to its new one must leave as many components as there were.
  CurveGraph both = graph;
  const auto offset = static_cast<std::uint32_t>(graph.nodes.size());
  both.nodes.insert(both.nodes.end(), merged.nodes.begin(), merged.nodes.end());
  for (const auto& [a, b] : merged.edges) {
    both.edges.push_back({offset + a, offset + b});
  }
  for (std::uint32_t i = 0; i < offset; ++i) {
    ASSERT_LT(node_of_vertex[i], merged.nodes.size());
    both.edges.push_back({i, offset + node_of_vertex[i]});
  }
  EXPECT_EQ(component_count(both), component_count(graph));
}

INSTANTIATE_TEST_SUITE_P(Seeds, MergeCloseNodes, testing::Range<std::uint64_t>(1, 21));

}  // namespace
}  // namespace vantage
