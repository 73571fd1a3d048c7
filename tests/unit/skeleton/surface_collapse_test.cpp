// SPDX-License-Identifier: MIT
#include "skeleton/surface_collapse.h"

#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "support/shapes.h"
#include "support/voxel_surface.h"

namespace vantage {
namespace {

using Levels = std::vector<std::vector<Vec3>>;

/// The bars of a cube of `n` cells a side.
TriMesh lattice(int n) {
  const auto is_bar = [](int i, int j, int k) { return i % 2 + j % 2 + k % 2 <= 1; };
  return test::voxel_surface(2 * n + 1, 2 * n + 1, 2 * n + 1, is_bar);
}

/// Each crossing of the bars near a point, then all handles shrunk into one another in a speck.
Levels to_a_speck(const TriMesh& bars) {
  Levels levels(2);
  Pcg32 random(1, 1);
  for (const Vec3& p : bars.positions) {
    const Vec3 crossing = 2.0 * (0.5 * p).array().floor() + 0.5;
    levels[0].emplace_back(crossing + 0.1 * (p - crossing));
    levels[1].emplace_back(1e-6 * random.uniform(), 1e-6 * random.uniform(),
                           1e-6 * random.uniform());
  }
  return levels;
}

/// As it is, and near the circle inside.
Levels to_a_ring(const TriMesh& torus) {
  Levels levels{torus.positions, {}};
  for (const Vec3& p : torus.positions) {
    const Vec3 centre = Vec3(p.x(), p.y(), 0.0).normalized();
    levels[1].emplace_back(centre + 0.02 * (p - centre));
  }
  return levels;
}

/// \param parts what becomes of each component of the mesh, in the order of its vertices.
Collapsed collapsed(const TriMesh& mesh, const std::vector<Levels>& parts) {
  ContractionHistory history;
  history.levels.resize(2);
  for (std::uint32_t part = 0; part < parts.size(); ++part) {
    for (std::size_t level = 0; level < 2; ++level) {
      const auto& from = parts[part][level];
      history.levels[level].insert(history.levels[level].end(), from.begin(), from.end());
    }
    history.component_of_vertex.resize(history.levels[0].size(), part);
  }
  return collapse_thinnest(mesh, history, 0.05, {});
}

TEST(CollapseThinnest, TakesAnEarlierLevelWhereHandlesWouldBeLost) {
  const TriMesh mesh = lattice(3);
  const Collapsed whole = collapsed(mesh, {to_a_speck(mesh)});
  EXPECT_EQ(whole.lost_handles, 0U);
  EXPECT_EQ(cycle_count(whole.graph), 144U - 64U + 1U);
}

// What one component needs is not done to another.
TEST(CollapseThinnest, OfEachComponentIsAsIfItWereAlone) {
  const TriMesh torus = test::torus(1.0, 0.25, 40, 14);
  const TriMesh bars = lattice(3);
  const Collapsed alone = collapsed(torus, {to_a_ring(torus)});
  const Collapsed both =
      collapsed(test::together(torus, bars, Vec3::Zero()), {to_a_ring(torus), to_a_speck(bars)});
  EXPECT_EQ(both.lost_handles, 0U);
  const std::size_t nodes = alone.graph.nodes.size();
  ASSERT_GT(both.graph.nodes.size(), nodes);
  const auto first = [](const auto& list, std::size_t count) {
    const auto of_all = std::span(list).first(count);
    return std::vector(of_all.begin(), of_all.end());
  };
  EXPECT_THAT(first(both.graph.nodes, nodes), ::testing::ElementsAreArray(alone.graph.nodes));
  EXPECT_THAT(first(both.node_of_vertex, torus.positions.size()),
              ::testing::ElementsAreArray(alone.node_of_vertex));
}

TEST(CollapseThinnest, CountsTheHandlesThatItsGraphHasNoCycleFor) {
  const TriMesh mesh = lattice(3);
  Levels levels = to_a_speck(mesh);
  levels[0] = levels[1];
  const Collapsed whole = collapsed(mesh, {levels});
  EXPECT_GT(whole.lost_handles, 0U);
  EXPECT_EQ(cycle_count(whole.graph) + whole.lost_handles, 144U - 64U + 1U);
}

}  // namespace
}  // namespace vantage
