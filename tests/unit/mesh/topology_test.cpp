// SPDX-License-Identifier: MIT
#include "vantage/mesh/topology.h"

#include <algorithm>
#include <iterator>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Three triangles on the edge 1–2, a face that names a vertex twice, and an isolated vertex 6.
TriMesh fin() {
  return {.positions = std::vector<Vec3>(7, Vec3::Zero()),
          .triangles = {{0, 1, 2}, {2, 1, 3}, {1, 2, 4}, {5, 5, 0}}};
}

TEST(BuildEdgeTable, SortsEdgesAndListsTheirFaces) {
  const EdgeTable table = build_edge_table(fin());
  EXPECT_THAT(table.edges, ElementsAre(std::array{0U, 1U}, std::array{0U, 2U}, std::array{1U, 2U},
                                       std::array{1U, 3U}, std::array{1U, 4U}, std::array{2U, 3U},
                                       std::array{2U, 4U}));
  EXPECT_THAT(table.faces_of_edge[2], ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(table.faces_of_edge[6], ElementsAre(2U));
}

TEST(BuildEdgeTable, HasOneRowAnEdge) {
  const EdgeTable table = build_edge_table(fin());
  EXPECT_EQ(table.faces_of_edge.size(), table.edges.size());
  EXPECT_EQ(build_edge_table({}).faces_of_edge.size(), 0U);
}

TEST(VertexNeighbours, AreAscendingAndEmptyForIsolatedVertices) {
  const IndexLists rings = vertex_neighbours(fin());
  ASSERT_EQ(rings.size(), 7U);
  EXPECT_THAT(rings[1], ElementsAre(0U, 2U, 3U, 4U));
  EXPECT_THAT(rings[2], ElementsAre(0U, 1U, 3U, 4U));
  EXPECT_THAT(rings[5], IsEmpty());
  EXPECT_THAT(rings[6], IsEmpty());
}

TEST(VertexFaces, ListAFaceThatNamesAVertexTwiceOnce) {
  const IndexLists faces = vertex_faces(fin());
  EXPECT_THAT(faces[5], ElementsAre(3U));
  EXPECT_THAT(faces[0], ElementsAre(0U, 3U));
  EXPECT_THAT(faces[6], IsEmpty());
}

TEST(ConnectedComponents, AreNumberedByLowestVertex) {
  const TriMesh mesh{.positions = std::vector<Vec3>(8, Vec3::Zero()),
                     .triangles = {{7, 3, 5}, {1, 6, 2}}};
  const Components components = connected_components(mesh);
  EXPECT_EQ(components.count, 4U);
  EXPECT_THAT(components.of_vertex, ElementsAre(0U, 1U, 1U, 2U, 3U, 2U, 1U, 2U));
}

TEST(ConnectedComponents, JoinOverASharedVertexAlone) {
  const TriMesh bow{.positions = std::vector<Vec3>(5, Vec3::Zero()),
                    .triangles = {{0, 1, 2}, {2, 3, 4}}};
  EXPECT_EQ(connected_components(bow).count, 1U);
}

TEST(EulerCharacteristic, OfATorusIsZeroAndOfASphereTwo) {
  for (const auto& [mesh, expected] :
       {std::pair{test::torus(1.0, 0.3, 12, 7), 0L}, std::pair{test::sphere(2), 2L}}) {
    const auto edges = static_cast<long>(build_edge_table(mesh).edges.size());
    EXPECT_EQ(
        static_cast<long>(mesh.positions.size()) - edges + static_cast<long>(mesh.triangles.size()),
        expected);
  }
}

/// Fans at v by growing them from each face over shared sides until nothing is added.
std::uint32_t fans_by_growing(const TriMesh& mesh, std::uint32_t v) {
  std::vector<Triangle> left;
  for (const Triangle& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && std::count(t.begin(), t.end(), v) == 1) {
      left.push_back(t);
    }
  }
  const auto share_a_side = [&](const Triangle& a, const Triangle& b) {
    return std::any_of(a.begin(), a.end(), [&](std::uint32_t w) {
      return w != v && std::count(b.begin(), b.end(), w) == 1;
    });
  };
  std::uint32_t fans = 0;
  while (!left.empty()) {
    std::vector<Triangle> fan{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const Triangle of = fan[i];
      const auto kept = std::partition(left.begin(), left.end(),
                                       [&](const Triangle& t) { return !share_a_side(of, t); });
      fan.insert(fan.end(), kept, left.end());
      left.erase(kept, left.end());
    }
    ++fans;
  }
  return fans;
}

TEST(CountFans, OfRandomFacesAreThoseGrownOverSharedSides) {
  std::mt19937 random(7);
  const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 9U); };
  for (int round = 0; round < 50; ++round) {
    TriMesh mesh;
    mesh.positions.assign(9, Vec3::Zero());
    std::generate_n(std::back_inserter(mesh.triangles), 14, [&] {
      return Triangle{vertex(), vertex(), vertex()};
    });
    const std::vector<std::uint32_t> fans = count_fans(mesh);
    for (std::uint32_t v = 0; v < 9; ++v) {
      EXPECT_EQ(fans[v], fans_by_growing(mesh, v)) << "round " << round << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace vantage
