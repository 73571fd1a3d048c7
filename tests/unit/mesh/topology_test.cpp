// SPDX-License-Identifier: MIT
#include "vantage/mesh/topology.h"

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

}  // namespace
}  // namespace vantage
