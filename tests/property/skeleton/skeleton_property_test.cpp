// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/measures.h"
#include "vantage/skeleton/skeleton.h"

#include "support/dense_oracles.h"
#include "support/many_threads.h"
#include "support/once.h"
#include "support/shapes.h"
#include "support/skeletons.h"
#include "support/voxel_surface.h"
#include "support/worst.h"
#include "unit/skeleton/genus_two.h"

namespace vantage {
namespace {

using test::skeleton_of;

struct Shape {
  std::string name;
  TriMesh mesh;
  std::size_t components;
  std::size_t genus;
  std::size_t ends;  ///< Nodes of one edge that the finished skeleton has.
};

/// Closed surfaces whose skeleton is known.
std::vector<Shape> shapes() {
  const TriMesh ring = test::torus(1.0, 0.25, 40, 12);
  return {
      {"torus", ring, 1, 1, 0},
      {"genus_two", test::genus_two(32, 12), 1, 2, 0},
      {"two_tori", test::together(ring, ring, Vec3(0.0, 0.0, 2.0)), 2, 2, 0},
      {"linked_tori",
       test::together(ring, test::moved(ring, 1.0, 1.5707963267948966, Vec3::UnitX(), Vec3::Zero()),
                      Vec3(1.0, 0.0, 0.0)),
       2, 2, 0},
      {"cylinder", test::cylinder(0.2, 3.0, 16, 40), 1, 0, 2},
      {"y", test::y_of_tubes(0.2, 24), 1, 0, 3}};
}

/// Surfaces of known topology whose ends depend on how their flat parts are cut up.
std::vector<Shape> blocky_shapes() {
  return {{"sphere", test::sphere(3), 1, 0, 0},
          {"box", test::box(1.0, 2.0, 3.0, 8), 1, 0, 0},
          {"plate_with_two_holes", test::plate_with_holes(2), 1, 2, 0},
          {"plate_with_five_holes", test::plate_with_holes(5), 1, 5, 0},
          {"cube_frame", test::cube_frame(), 1, 5, 0}};
}

std::size_t end_count(const CurveGraph& graph) {
  std::vector<int> degree(graph.nodes.size(), 0);
  for (const auto& [a, b] : graph.edges) {
    ++degree[a];
    ++degree[b];
  }
  return static_cast<std::size_t>(std::count(degree.begin(), degree.end(), 1));
}

void expect_topology(const Shape& shape, const CurveGraph& graph) {
  EXPECT_EQ(component_count(graph), shape.components);
  EXPECT_EQ(cycle_count(graph), shape.genus);
}

/// The contraction and the skeleton of a shape as it is, each computed once a process.
const ContractionHistory& contraction_as_is(const Shape& shape) {
  return test::once(shape.name, [&] { return contract(shape.mesh); });
}

const Skeleton& skeleton_as_is(const Shape& shape) {
  return test::once(shape.name,
                    [&] { return extract_skeleton(shape.mesh, contraction_as_is(shape)); });
}

/// Turned about an axis, scaled and shifted.
TriMesh placed(const TriMesh& mesh, double scale) {
  return test::moved(mesh, scale, 0.9, Vec3(1.0, -2.0, 0.7), scale * Vec3(3.0, 1.0, -2.0));
}

/// The skeleton of a shape so placed, extracted once a process.
const Skeleton& skeleton_placed(const Shape& shape, double scale) {
  return test::once(std::pair(shape.name, scale),
                    [&] { return skeleton_of(placed(shape.mesh, scale)); });
}

/// The skeleton of a shape renumbered, extracted once a process.
const Skeleton& skeleton_renumbered(const Shape& shape, unsigned seed) {
  return test::once(std::pair(shape.name, seed),
                    [&] { return skeleton_of(test::renumbered(shape.mesh, seed)); });
}

/// The skeleton of a graph's shape, moved as `placed()` moves the shape.
CurveGraph placed(CurveGraph graph, double scale) {
  graph.nodes = placed(TriMesh{.positions = graph.nodes, .triangles = {}}, scale).positions;
  return graph;
}

class SkeletonProperty : public testing::TestWithParam<Shape> {};

TEST_P(SkeletonProperty, HasAComponentPerComponentAndACyclePerHandle) {
  const Skeleton& skeleton = skeleton_as_is(GetParam());
  expect_topology(GetParam(), skeleton.graph);
  expect_topology(GetParam(), skeleton.raw);
  EXPECT_TRUE(skeleton.warnings.empty());
}

TEST_P(SkeletonProperty, HasAnEndPerTip) {
  EXPECT_EQ(end_count(skeleton_as_is(GetParam()).graph), GetParam().ends);
}

TEST_P(SkeletonProperty, MapsEveryVertexToANode) {
  const Skeleton& skeleton = skeleton_as_is(GetParam());
  ASSERT_EQ(skeleton.node_of_vertex.size(), GetParam().mesh.positions.size());
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    ASSERT_LT(skeleton.node_of_vertex[v], skeleton.graph.nodes.size());
    ASSERT_LT(skeleton.raw_node_of_vertex[v], skeleton.raw.nodes.size());
  }
}

TEST_P(SkeletonProperty, RadiusIsTheMeanDistanceToTheVerticesOfANode) {
  // A refined surface has vertices that are not the mesh's.
  const ContractionHistory history =
      contract(GetParam().mesh, {.weights = ContractionWeights::Vertex});
  ASSERT_FALSE(history.refinement);
  const Skeleton skeleton = extract_skeleton(GetParam().mesh, history);
  std::vector<double> sum(skeleton.graph.nodes.size(), 0.0);
  std::vector<double> count(skeleton.graph.nodes.size(), 0.0);
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const std::uint32_t node = skeleton.node_of_vertex[v];
    sum[node] += (GetParam().mesh.positions[v] - skeleton.graph.nodes[node]).norm();
    count[node] += 1.0;
  }
  ASSERT_EQ(skeleton.radius.size(), sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(skeleton.radius[i], count[i] > 0.0 ? sum[i] / count[i] : 0.0, 1e-12);
  }
}

TEST_P(SkeletonProperty, EveryVertexIsWithinThreeLocalRadiiOfTheGraph) {
  const Skeleton& skeleton = skeleton_as_is(GetParam());
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const double distance =
        test::brute_force_distance(skeleton.graph, GetParam().mesh.positions[v]);
    ASSERT_LE(distance, 3.0 * skeleton.radius[skeleton.node_of_vertex[v]]) << "vertex " << v;
  }
}

TEST_P(SkeletonProperty, NodesOfTheFinishedGraphAreInsideTheShell) {
  const Skeleton& skeleton = skeleton_as_is(GetParam());
  for (const Vec3& node : skeleton.graph.nodes) {
    EXPECT_NEAR(test::winding_number(GetParam().mesh, node), 1.0, 1e-6) << node.transpose();
  }
}

TEST(SkeletonOfALattice, HasAllHandlesOfACubeOfThreeByThreeByThree) {
  // 64 crossings, 144 bars.
  const auto is_bar = [](int i, int j, int k) { return i % 2 + j % 2 + k % 2 <= 1; };
  EXPECT_EQ(cycle_count(skeleton_of(test::voxel_surface(7, 7, 7, is_bar)).graph), 144U - 64U + 1U);
}

TEST_P(SkeletonProperty, AWiderSpacingGivesFewerNodesAndTheSameTopology) {
  const auto spaced = [&](double spacing) {
    return extract_skeleton(GetParam().mesh, contraction_as_is(GetParam()), {.spacing = spacing});
  };
  const Skeleton skeleton = spaced(0.05);
  const CurveGraph coarser = spaced(0.1).raw;
  EXPECT_LT(coarser.nodes.size(), skeleton.raw.nodes.size());
  expect_topology(GetParam(), coarser);
}

TEST_P(SkeletonProperty, RenumberingKeepsComponentsCyclesAndEnds) {
  for (const unsigned seed : {1U, 2U}) {
    const Skeleton& skeleton = skeleton_renumbered(GetParam(), seed);
    expect_topology(GetParam(), skeleton.graph);
    EXPECT_EQ(end_count(skeleton.graph), GetParam().ends) << "seed " << seed;
  }
}

TEST_P(SkeletonProperty, RotationAndScaleKeepComponentsCyclesAndEnds) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Skeleton& skeleton = skeleton_placed(GetParam(), scale);
    expect_topology(GetParam(), skeleton.graph);
    EXPECT_EQ(end_count(skeleton.graph), GetParam().ends) << "scale " << scale;
  }
}

TEST_P(SkeletonProperty, IsInsideAndSeesTheWholeSurface) {
  const SkeletonQuality quality =
      measure_skeleton(GetParam().mesh, contraction_as_is(GetParam()).component_of_vertex,
                       skeleton_as_is(GetParam()), 0.0);
  EXPECT_EQ(quality.outside_length, 0.0);
  EXPECT_EQ(quality.seen_fraction, 1.0);
}

/// Largest distance from a node of one graph to the other, both ways.
double node_distance(const CurveGraph& one, const CurveGraph& other) {
  double farthest = 0.0;
  for (const Vec3& p : one.nodes) {
    farthest = test::larger(farthest, test::brute_force_distance(other, p));
  }
  for (const Vec3& p : other.nodes) {
    farthest = test::larger(farthest, test::brute_force_distance(one, p));
  }
  return farthest;
}

TEST_P(SkeletonProperty, LiesWithinTwoSpacingsOfTheRenumberedOne) {
  const TriMesh& mesh = GetParam().mesh;
  const CurveGraph& graph = skeleton_as_is(GetParam()).graph;
  const CurveGraph& other = skeleton_renumbered(GetParam(), 1).graph;
  EXPECT_LE(node_distance(graph, other), 2.0 * sample_spacing(mesh, {}));
}

TEST_P(SkeletonProperty, LiesWithinTwoSpacingsOfTheMovedOneMovedBack) {
  const TriMesh& mesh = GetParam().mesh;
  for (const double scale : {1e-6, 1e6}) {
    EXPECT_LE(node_distance(placed(skeleton_as_is(GetParam()).graph, scale),
                            skeleton_placed(GetParam(), scale).graph),
              2.0 * scale * sample_spacing(mesh, {}));
  }
}

TEST_P(SkeletonProperty, IsTheSameToTheBitForAnyThreadCount) {
  const auto run = [&](int threads) {
    const RunContext context{.max_threads = threads};
    return test::with_many_threads([&] {
      return extract_skeleton(GetParam().mesh, contract(GetParam().mesh, {}, context), {}, context);
    });
  };
  const Skeleton alone = run(1);
  for (const int threads : {0, 3}) {  // 0: as many as there are cores
    const Skeleton& skeleton = threads == 0 ? skeleton_as_is(GetParam()) : run(threads);
    EXPECT_TRUE(skeleton.graph.nodes == alone.graph.nodes &&
                skeleton.graph.edges == alone.graph.edges && skeleton.radius == alone.radius &&
                skeleton.node_of_vertex == alone.node_of_vertex &&
                skeleton.raw.nodes == alone.raw.nodes)
        << threads << " threads";
  }
}

/// A surface, symmetric before, that now is only its own mirror image: full of edges of equal length.
TriMesh bent(TriMesh mesh) {
  const Box box = bounding_box(mesh.positions);
  const Vec3 middle = box.low + 0.5 * box.size();
  for (Vec3& p : mesh.positions) {
    const double x = (p.x() - middle.x()) / box.size().x();
    const double z = (p.z() - middle.z()) / box.size().z();
    p.y() = middle.y() + (p.y() - middle.y()) * (1.0 + 0.5 * x + 0.2 * z);
    p.x() += 0.3 * z * z;
  }
  return mesh;
}

TEST(SkeletonOfEquals, IsTheSameHoweverTheModelIsNumberedAndTurned) {
  for (const TriMesh& shape : {test::box(1.0, 2.0, 3.0, 8), test::sphere(3), test::cube_frame()}) {
    const TriMesh mesh = bent(shape);
    const CurveGraph graph = skeleton_of(mesh).graph;
    const CurveGraph moved = placed(graph, 1.0);
    for (const unsigned seed : {1U, 2U, 3U}) {
      const CurveGraph other = skeleton_of(test::renumbered(placed(mesh, 1.0), seed)).graph;
      EXPECT_LE(node_distance(moved, other), 1e-6 * enclosing_sphere(mesh.positions).diameter)
          << mesh.positions.size() << " vertices, seed " << seed;
    }
  }
}

class SkeletonTopology : public testing::TestWithParam<Shape> {};

TEST_P(SkeletonTopology, IsThatOfTheSurface) {
  expect_topology(GetParam(), skeleton_as_is(GetParam()).graph);
}

TEST_P(SkeletonTopology, StaysUnderRenumbering) {
  expect_topology(GetParam(), skeleton_renumbered(GetParam(), 2).graph);
}

TEST_P(SkeletonTopology, StaysUnderSimilarities) {
  for (const double scale : {1e-6, 1e6}) {
    expect_topology(GetParam(), skeleton_placed(GetParam(), scale).graph);
  }
}

TEST_P(SkeletonTopology, DoesNotDependOnTheWinding) {
  expect_topology(GetParam(), skeleton_of(test::inside_out(GetParam().mesh)).graph);
}

TEST_P(SkeletonTopology, ComesWithoutLoopsOrDoubledEdges) {
  const CurveGraph& graph = skeleton_as_is(GetParam()).graph;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    ASSERT_LT(graph.edges[e][0], graph.edges[e][1]);
    ASSERT_LT(graph.edges[e][1], graph.nodes.size());
    ASSERT_TRUE(e == 0 || graph.edges[e - 1] < graph.edges[e]);
  }
}

TEST_P(SkeletonTopology, LosesNoLimb) {
  // Flat parts are far from any curve compared with the mean of their own node; a lost limb would
  // make its node's larger, and so the mean of all nodes counts as well.
  const Skeleton& skeleton = skeleton_as_is(GetParam());
  double mean = 0.0;
  for (const double radius : skeleton.radius) {
    mean += radius / static_cast<double>(skeleton.radius.size());
  }
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const double distance =
        test::brute_force_distance(skeleton.graph, GetParam().mesh.positions[v]);
    ASSERT_LE(distance, 3.0 * skeleton.radius[skeleton.node_of_vertex[v]]) << "vertex " << v;
    ASSERT_LE(distance, 4.0 * mean) << "vertex " << v;
  }
}

// An odd number of shapes comes last: those above then meet each of theirs in one of two processes.
/// Surfaces that are not contracted as they are: too large, or of too few faces.
std::vector<Shape> shapes_contracted_otherwise() {
  return {{"proxy_y", test::y_of_tubes(0.2, 85), 1, 0, 3},
          {"refined_beam", test::box(10.0, 1.0, 1.0, 1), 1, 0, 2},
          {"refined_ring", test::torus(1.0, 0.3, 6, 4), 1, 1, 0}};
}

class SkeletonStrategy : public testing::TestWithParam<Shape> {};

TEST_P(SkeletonStrategy, KeepsTheGraphUnderRenumberingAndSimilarities) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionHistory history = contract(mesh);
  EXPECT_EQ(history.components.front().strategy.substr(0, 5), GetParam().name.substr(0, 5));
  const CurveGraph graph = extract_skeleton(mesh, history).graph;
  expect_topology(GetParam(), graph);
  EXPECT_EQ(end_count(graph), GetParam().ends);
  for (const double scale : {1e-6, 1e6}) {
    const CurveGraph other = skeleton_of(test::renumbered(placed(mesh, scale), 3)).graph;
    expect_topology(GetParam(), other);
    EXPECT_EQ(end_count(other), GetParam().ends) << "scale " << scale;
    EXPECT_LE(node_distance(placed(graph, scale), other), 2.0 * scale * sample_spacing(mesh, {}));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SkeletonTopology, testing::ValuesIn(shapes()),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(Blocks, SkeletonTopology, testing::ValuesIn(blocky_shapes()),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(Shapes, SkeletonStrategy, testing::ValuesIn(shapes_contracted_otherwise()),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(Shapes, SkeletonProperty, testing::ValuesIn(shapes()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace vantage
