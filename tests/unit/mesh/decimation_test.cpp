// SPDX-License-Identifier: MIT
#include "mesh/decimation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "core/random.h"
#include "mesh/edge_splitting.h"
#include "support/shapes.h"

namespace vantage {
namespace {

/// V − E + F.
long euler_characteristic(const TriMesh& mesh) {
  return static_cast<long>(mesh.positions.size()) -
         static_cast<long>(build_edge_table(mesh).edges.size()) +
         static_cast<long>(mesh.triangles.size());
}

std::size_t border_edges(const TriMesh& mesh) {
  const EdgeTable table = build_edge_table(mesh);
  std::size_t count = 0;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    count += table.faces_of_edge[e].size() == 1 ? 1 : 0;
  }
  return count;
}

TEST(Decimate, LeavesAsManyVerticesAsAsked) {
  EXPECT_EQ(decimate(test::sphere(4), 500, {}).mesh.positions.size(), 500U);
}

TEST(Decimate, KeepsTheHandleOfATorusDownToWhatCanBeKept) {
  const Decimation coarse = decimate(test::torus(1.0, 0.3, 60, 24), 0, {});
  EXPECT_LT(coarse.mesh.positions.size(), 100U);
  EXPECT_EQ(euler_characteristic(coarse.mesh), 0);
  EXPECT_EQ(border_edges(coarse.mesh), 0U);
}

TEST(Decimate, KeepsASphereClosedDownToATetrahedron) {
  const Decimation coarse = decimate(test::sphere(3), 0, {});
  EXPECT_GE(coarse.mesh.positions.size(), 4U);
  EXPECT_EQ(euler_characteristic(coarse.mesh), 2);
}

TEST(Decimate, KeepsBothRimsOfAnOpenCylinder) {
  const Decimation coarse = decimate(test::open_cylinder(0.3, 3.0, 24, 60), 200, {});
  EXPECT_EQ(euler_characteristic(coarse.mesh), 0);
  EXPECT_GE(border_edges(coarse.mesh), 6U);
}

/// Triangles between few vertices, some of them twice; every vertex has one.
TriMesh tangle(std::uint64_t seed) {
  Pcg32 random(seed);
  const auto pick = [&](std::size_t count) {
    return static_cast<std::uint32_t>(random.uniform() * static_cast<double>(count));
  };
  TriMesh mesh;
  for (int i = 0; i < 60; ++i) {
    mesh.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  for (std::uint32_t v = 0; v < 60; ++v) {
    const std::uint32_t near = v / 6 * 6;  // ten parts of six vertices
    const std::uint32_t a = near + (v - near + 1 + pick(5)) % 6;
    std::uint32_t b = near + pick(6);
    while (b == a || b == v) {
      b = near + pick(6);
    }
    mesh.triangles.push_back({v, a, b});
    if (random.uniform() < 0.5) {
      mesh.triangles.push_back({a, b, v});
    }
  }
  return mesh;
}

TEST(Decimate, KeepsComponentsWhereFacesStandTwiceAndEdgesHaveMany) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const TriMesh mesh = tangle(seed);
    const TriMesh coarse = decimate(mesh, 0, {}).mesh;
    EXPECT_EQ(connected_components(coarse).count, connected_components(mesh).count) << seed;
  }
}

TEST(Decimate, StaysOnASphereToAFewPercent) {
  const Decimation coarse = decimate(test::sphere(4), 400, {});
  for (const Vec3& p : coarse.mesh.positions) {
    // A vertex stands for 4π / 400 square units, a patch of radius 0.1. Quadrics put it where the
    // tangent planes meet that it stands for; those at the rim meet 0.1² / 2 above the sphere.
    EXPECT_NEAR(p.norm(), 1.0, 0.005);
  }
}

TEST(Decimate, NamesACoarseVertexForEveryFineOneAndEachCoarseOneIsNamed) {
  const Decimation coarse = decimate(test::torus(1.0, 0.3, 60, 24), 300, {});
  const std::set<std::uint32_t> named(coarse.of_vertex.begin(), coarse.of_vertex.end());
  EXPECT_EQ(coarse.of_vertex.size(), 60U * 24U);
  EXPECT_EQ(named.size(), coarse.mesh.positions.size());
  EXPECT_EQ(*named.rbegin() + 1, coarse.mesh.positions.size());
}

TEST(Decimate, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(decimate(test::sphere(3), 10, {.stop = source.get_token()}), Cancelled);
}

constexpr std::size_t kAny = ~std::size_t{0};  // vertices

TEST(MergeShortEdges, LeavesNoEdgeThatIsShortAndMayGo) {
  const TriMesh torus = test::torus(1.0, 0.3, 60, 24);
  const std::vector<double> weights(torus.positions.size(), 1.0);
  const Decimation merged = merge_short_edges(torus, weights, 0.15, {});
  EXPECT_EQ(euler_characteristic(merged.mesh), 0);
  const IndexLists rings = vertex_neighbours(merged.mesh);
  for (const auto& [a, b] : build_edge_table(merged.mesh).edges) {
    if ((merged.mesh.positions[a] - merged.mesh.positions[b]).norm() < 0.15) {
      std::vector<std::uint32_t> common;
      std::set_intersection(rings[a].begin(), rings[a].end(), rings[b].begin(), rings[b].end(),
                            std::back_inserter(common));
      EXPECT_NE(common.size(), 2U) << a << " " << b;  // the link condition
    }
  }
}

TEST(MergeShortEdges, MergesTheSameAtAnyScale) {
  const TriMesh torus = test::torus(1.0, 0.3, 60, 24);
  const std::vector<double> weights(torus.positions.size(), 1.0);
  const Decimation merged = merge_short_edges(torus, weights, 0.15, {});
  for (const int exponent : {-90, 130}) {  // squares of lengths are beyond what float holds
    TriMesh scaled = torus;
    for (Vec3& p : scaled.positions) {
      p *= std::ldexp(1.0, exponent);
    }
    const Decimation found = merge_short_edges(scaled, weights, std::ldexp(0.15, exponent), {});
    EXPECT_EQ(found.mesh.triangles, merged.mesh.triangles);
    EXPECT_EQ(found.mesh.positions[0], std::ldexp(1.0, exponent) * merged.mesh.positions[0]);
  }
}

TEST(MergeShortEdges, LeavesLongEdgesAlone) {
  const TriMesh box = test::box(1, 1, 1, 2);
  const std::vector<double> weights(box.positions.size(), 1.0);
  EXPECT_EQ(merge_short_edges(box, weights, 0.4, {}).mesh.triangles, box.triangles);
}

TEST(SplitLongEdges, KeepsTheVerticesInFrontAndTheTopology) {
  const TriMesh box = test::box(1, 2, 3, 1);
  const TriMesh fine =
      split_long_edges(box, std::vector<double>(box.triangles.size(), 0.3), kAny, {}).value();
  EXPECT_EQ(euler_characteristic(fine), 2);
  EXPECT_EQ(border_edges(fine), 0U);
  EXPECT_TRUE(std::equal(box.positions.begin(), box.positions.end(), fine.positions.begin()));
  for (const auto& [a, b] : build_edge_table(fine).edges) {
    EXPECT_LE((fine.positions[a] - fine.positions[b]).norm(), 0.3 * (1.0 + 1e-9));
  }
}

TEST(SplitLongEdges, KeepsNeighboursOfBoundedFacesFitting) {
  const TriMesh box = test::box(1, 1, 1, 1);
  std::vector<double> longest(box.triangles.size(), std::numeric_limits<double>::infinity());
  longest[0] = 0.4;
  const TriMesh fine = split_long_edges(box, longest, kAny, {}).value();
  EXPECT_GT(fine.triangles.size(), box.triangles.size());
  EXPECT_EQ(border_edges(fine), 0U);
}

TEST(SplitLongEdges, EndsWhereMiddlesAreNoPlacesOfTheirOwn) {
  TriMesh box = test::box(1, 1, 1, 1);
  for (Vec3& p : box.positions) {
    p += Vec3::Constant(1e15);  // 8 steps from one double to the next
  }
  const TriMesh fine =
      split_long_edges(box, std::vector<double>(box.triangles.size(), 0.04), kAny, {}).value();
  constexpr std::size_t kPlacesOnTheSides = 6 * 9 * 9;
  EXPECT_LT(fine.positions.size(), 4 * kPlacesOnTheSides);
}

TEST(Decimate, DoesNotDependOnTheUnitOfLength) {
  const TriMesh mesh = test::torus(1.0, 0.4, 40, 20);
  const Decimation whole = decimate(mesh, 200, {});
  for (const double scale : {0x1p100, 0x1p-100}) {  // powers of two never round
    const Decimation scaled =
        decimate(test::moved(mesh, scale, 0.0, Vec3::UnitX(), Vec3::Zero()), 200, {});
    ASSERT_EQ(scaled.of_vertex, whole.of_vertex) << scale;
    EXPECT_EQ(scaled.mesh.positions[7], Vec3(scale * whole.mesh.positions[7])) << scale;
  }
}

/// A torus of which all coordinates are told exactly a million diameters away, too.
TEST(Decimate, DoesNotDependOnThePlace) {
  TriMesh mesh = test::torus(1.0, 0.4, 40, 20);
  for (Vec3& p : mesh.positions) {
    p = (0x1p24 * p).array().round() * 0x1p-24;
  }
  const Vec3 far(0x1p21, -0x1p22, 0x1p20);
  const Decimation here = decimate(mesh, 200, {});
  const Decimation there = decimate(test::moved(mesh, 1.0, 0.0, Vec3::UnitX(), far), 200, {});
  ASSERT_EQ(there.of_vertex, here.of_vertex);
  EXPECT_EQ(there.mesh.triangles, here.mesh.triangles);
  for (std::size_t v = 0; v < here.mesh.positions.size(); ++v) {
    EXPECT_LT((there.mesh.positions[v] - far - here.mesh.positions[v]).norm(), 1e-8) << v;
  }
}

TEST(DecimateTwice, EndsWhereDecimateEndsAndRestsBetweenPasses) {
  const TriMesh ball = test::sphere(4);  // 2 562 vertices
  const TwoDecimations two = decimate_twice(ball, 1500, 400, {});
  EXPECT_EQ(two.coarse.mesh.positions, decimate(ball, 400, {}).mesh.positions);
  EXPECT_EQ(two.coarse.of_vertex, decimate(ball, 400, {}).of_vertex);
  EXPECT_LE(two.between.mesh.positions.size(), 1500U);
  EXPECT_GT(two.between.mesh.positions.size(), 400U);
}

}  // namespace
}  // namespace vantage
