// SPDX-License-Identifier: MIT
#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/mesh/mesh_check.h"

#include "support/shapes.h"

namespace vantage {
namespace {

using ::testing::ElementsAre;

TEST(Weld, KeepsTheOrderOfFirstAppearance) {
  const TriMesh mesh{.positions = {{5, 0, 0}, {1, 0, 0}, {5, 0, 0}, {0, 0, 0}, {1, 0, 0}},
                     .triangles = {{2, 4, 3}}};
  const WeldedMesh welded = weld(mesh);
  EXPECT_THAT(welded.mesh.positions, ElementsAre(Vec3(5, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)));
  EXPECT_THAT(welded.welded_of_vertex, ElementsAre(0U, 1U, 0U, 2U, 1U));
  EXPECT_EQ(welded.merged_vertices, 2U);
  EXPECT_THAT(welded.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Weld, TakesMinusZeroForZero) {
  const TriMesh mesh{.positions = {{0.0, 1, 2}, {-0.0, 1, 2}, {0.0, 1, -0.0}, {-0.0, 1, 0.0}},
                     .triangles = {}};
  EXPECT_THAT(weld(mesh).welded_of_vertex, ElementsAre(0U, 0U, 1U, 1U));
}

TEST(Weld, KeepsPointsApartThatDifferInTheLastBit) {
  const TriMesh mesh{.positions = {{1.0, 0, 0}, {1.0 + 0x1p-52, 0, 0}}, .triangles = {}};
  EXPECT_EQ(weld(mesh).merged_vertices, 0U);
}

TEST(Weld, DropsFacesThatNameOnePositionTwice) {
  const TriMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                     .triangles = {{0, 1, 2}, {0, 3, 1}, {1, 1, 2}}};
  const WeldedMesh welded = weld(mesh);
  EXPECT_EQ(welded.dropped_faces, 2U);
  EXPECT_THAT(welded.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Weld, StartsEachFaceAtItsLowestVertexAndKeepsItsWinding) {
  const TriMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     .triangles = {{0, 1, 2}, {2, 3, 1}, {3, 2, 0}}};
  EXPECT_THAT(weld(mesh).mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{1, 2, 3}, Triangle{0, 3, 2}));
}

TEST(Weld, OfPointsOnASmallGridIsWhatComparingAllPairsGives) {
  std::mt19937 random(3);
  const auto step = [&] { return static_cast<double>(random() % 4U); };
  TriMesh mesh;
  for (int i = 0; i < 200; ++i) {
    mesh.positions.emplace_back(step(), step(), step());
  }
  const WeldedMesh welded = weld(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto first = std::find(mesh.positions.begin(), mesh.positions.end(), mesh.positions[v]);
    EXPECT_EQ(welded.welded_of_vertex[v],
              welded.welded_of_vertex[static_cast<std::size_t>(first - mesh.positions.begin())]);
    EXPECT_EQ(welded.mesh.positions[welded.welded_of_vertex[v]], mesh.positions[v]);
  }
}

TEST(Weld, PutsASoupTogetherAgain) {
  const TriMesh torus = test::torus(1.0, 0.3, 12, 7);
  const WeldedMesh welded = weld(test::soup(torus));
  EXPECT_EQ(welded.mesh.positions.size(), torus.positions.size());
  EXPECT_EQ(welded.merged_vertices, 3 * torus.triangles.size() - torus.positions.size());
}

}  // namespace
}  // namespace vantage
