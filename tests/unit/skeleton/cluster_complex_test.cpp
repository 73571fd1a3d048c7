// SPDX-License-Identifier: MIT
#include "skeleton/cluster_complex.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

ClusterComplex complex_of(const TriMesh& mesh) {
  return {mesh, mesh.positions, std::vector<double>(mesh.positions.size(), 1.0)};
}

std::optional<std::uint32_t> edge_between(const ClusterComplex& complex, std::uint32_t a,
                                          std::uint32_t b) {
  for (const auto& link : complex.links(a)) {
    if (link.cluster == b) {
      return link.edge;
    }
  }
  return std::nullopt;
}

std::size_t live_edges(const ClusterComplex& complex) {
  std::size_t count = 0;
  for (std::uint32_t e = 0; e < complex.edge_count(); ++e) {
    count += complex.edge_is_live(e) ? 1U : 0U;
  }
  return count;
}

/// Sum over the live edges of the triangles at each: three times the triangles.
std::size_t face_sides(const ClusterComplex& complex) {
  std::size_t sum = 0;
  for (std::uint32_t e = 0; e < complex.edge_count(); ++e) {
    sum += complex.edge_is_live(e) ? complex.faces_at(e) : 0U;
  }
  return sum;
}

/// Triangular prism without lids: its rims 0-1-2 and 3-4-5 are loops without a face.
TriMesh tunnel() {
  return test::open_cylinder(1.0, 1.0, 3, 1);
}

TriMesh tetrahedron() {
  return {{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST(ClusterComplex, BeginsAsTheMesh) {
  const ClusterComplex complex = complex_of(tetrahedron());
  EXPECT_EQ(complex.face_count(), 4U);
  EXPECT_EQ(live_edges(complex), 6U);
}

TEST(ClusterComplex, CountsAFaceThatStandsTwiceOnce) {
  TriMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 0, 2});
  const ClusterComplex complex = complex_of(mesh);
  EXPECT_EQ(complex.face_count(), 4U);
  EXPECT_EQ(face_sides(complex), 12U);
}

TEST(ClusterComplex, LeavesOutAFaceThatNamesAVertexTwice) {
  TriMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 1, 2});
  EXPECT_EQ(complex_of(mesh).face_count(), 4U);
}

TEST(ClusterComplex, CollapsingMergesTwinEdges) {
  // Of 12 edges, 0–1 goes, and 0–2 with 1–2 and 0–4 with 1–4 become one each.
  ClusterComplex complex = complex_of(tunnel());
  ASSERT_EQ(live_edges(complex), 12U);
  complex.collapse(edge_between(complex, 0, 1).value());
  EXPECT_EQ(live_edges(complex), 12U - 3U);
}

TEST(ClusterComplex, CollapsingMergesTwinTriangles) {
  // Of four triangles the two at the edge go, and the two others end among the same three clusters.
  ClusterComplex complex = complex_of(tetrahedron());
  complex.collapse(edge_between(complex, 0, 1).value());
  EXPECT_EQ(complex.face_count(), 1U);
  EXPECT_EQ(face_sides(complex), 3U);
}

TEST(ClusterComplex, CollapsingKeepsTheCountOfTrianglesAtEdges) {
  ClusterComplex complex = complex_of(test::sphere(1));
  for (int i = 0; i < 10; ++i) {
    std::uint32_t e = 0;
    while (!complex.edge_is_live(e) || complex.faces_at(e) == 0) {
      ++e;
    }
    complex.collapse(e);
    EXPECT_EQ(face_sides(complex), 3 * complex.face_count());
  }
}

TEST(ClusterComplex, TheClusterWithMoreNeighboursStays) {
  // Vertex 0 of the fan has five neighbours, vertex 5 has two.
  TriMesh fan;
  fan.positions.assign(6, Vec3::Zero());
  fan.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  ClusterComplex complex = complex_of(fan);
  EXPECT_EQ(complex.collapse(edge_between(complex, 0, 5).value()), 0U);
  EXPECT_EQ(complex.cluster_of(5), 0U);
}

TEST(ClusterComplex, OfEqualClustersTheLowerStays) {
  ClusterComplex complex = complex_of(tetrahedron());
  EXPECT_EQ(complex.collapse(edge_between(complex, 3, 1).value()), 1U);
}

TEST(ClusterComplex, AMergedClusterStandsAtTheWeightedMean) {
  const TriMesh mesh = tetrahedron();
  ClusterComplex complex(mesh, mesh.positions, {3.0, 1.0, 1.0, 1.0});
  const std::uint32_t kept = complex.collapse(edge_between(complex, 0, 1).value());
  EXPECT_DOUBLE_EQ((complex.position(kept) - Vec3(0.25, 0.0, 0.0)).norm(), 0.0);
}

TEST(ClusterComplex, AnEdgeOfASolidCornerPinchesNothing) {
  const ClusterComplex complex = complex_of(tetrahedron());
  EXPECT_TRUE(complex.pinched_by(edge_between(complex, 0, 1).value()).empty());
}

TEST(ClusterComplex, AnEdgeOfARimOfThreePinchesTheRim) {
  const ClusterComplex complex = complex_of(tunnel());
  EXPECT_EQ(complex.pinched_by(edge_between(complex, 0, 1).value()),
            (std::vector<std::uint32_t>{2}));
}

/// Torus of 3 × 3 quads: every grid line is a loop of three edges without a face.
TriMesh smallest_torus() {
  return test::torus(1.0, 0.4, 3, 3);
}

TEST(ClusterComplex, TheFirstPinchOfATorusKeepsItsHandle) {
  ClusterComplex complex = complex_of(smallest_torus());
  const std::uint32_t around_the_tube = edge_between(complex, 0, 1).value();
  ASSERT_EQ(complex.pinched_by(around_the_tube), (std::vector<std::uint32_t>{2}));
  EXPECT_TRUE(complex.keeps_handles(around_the_tube));
}

TEST(ClusterComplex, APinchAlongTheTubeAfterOneAroundItWouldLoseTheHandle) {
  ClusterComplex complex = complex_of(smallest_torus());
  complex.collapse(edge_between(complex, 0, 1).value());
  EXPECT_FALSE(complex.keeps_handles(edge_between(complex, 5, 8).value()));
}

TEST(ClusterComplex, MakingRoomFreesTheWay) {
  ClusterComplex complex = complex_of(smallest_torus());
  complex.collapse(edge_between(complex, 0, 1).value());
  const std::uint32_t edge = edge_between(complex, 5, 8).value();
  complex.make_room(edge);
  EXPECT_TRUE(complex.keeps_handles(edge));
}

TEST(ClusterComplex, MakingRoomKeepsTheCountOfTrianglesAtEdges) {
  ClusterComplex complex = complex_of(smallest_torus());
  complex.collapse(edge_between(complex, 0, 1).value());
  const std::size_t before = complex.face_count();
  complex.make_room(edge_between(complex, 5, 8).value());
  EXPECT_GT(complex.face_count(), before);
  EXPECT_EQ(face_sides(complex), 3 * complex.face_count());
}

TEST(ClusterComplex, MakingRoomForAnEdgeThatKeepsHandlesChangesNothing) {
  ClusterComplex complex = complex_of(smallest_torus());
  const std::size_t before = complex.edge_count();
  complex.make_room(edge_between(complex, 0, 1).value());
  EXPECT_EQ(complex.edge_count(), before);
}

TEST(ClusterComplex, ItsGraphMapsEveryVertexToTheNodeOfItsCluster) {
  ClusterComplex complex = complex_of(tetrahedron());
  complex.collapse(edge_between(complex, 1, 2).value());
  const auto [graph, node_of_vertex] = complex.graph();
  EXPECT_EQ(graph.nodes.size(), 3U);
  EXPECT_EQ(node_of_vertex, (std::vector<std::uint32_t>{0, 1, 1, 2}));
  EXPECT_EQ(graph.edges, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {0, 2}, {1, 2}}));
}

}  // namespace
}  // namespace vantage
