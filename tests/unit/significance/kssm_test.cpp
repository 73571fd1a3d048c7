// SPDX-License-Identifier: MIT
#include "vantage/significance/kssm.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/skeleton/skeleton.h"

#include "support/dense_oracles.h"
#include "support/shapes.h"

namespace vantage {
namespace {

/// A strip of four vertices and two triangles, and a graph of one node at the origin, so that the
/// displacement of a level is the distance of its points from the origin.
struct HandMade {
  TriMesh mesh{.positions = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {5, 0, 0}},
               .triangles = {{0, 1, 2}, {1, 3, 2}}};
  CurveGraph graph{.nodes = {{0, 0, 0}}, .edges = {}};
  ContractionHistory history{.levels = {mesh.positions}};
};

TEST(ComputeKssm, OfOneLevelIsThatLevelNormalisedAndSuppressed) {
  const HandMade made;
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph);
  // d = 1, 2, 3, 5; D = 0, 1/4, 1/2, 1; mean without the maximum 1/4; factor (3/4)².
  const double factor = 0.75 * 0.75;
  ASSERT_EQ(map.level_factor.size(), 1U);
  EXPECT_DOUBLE_EQ(map.level_factor[0], factor);
  EXPECT_DOUBLE_EQ(map.of_vertex[0], 0.0);
  EXPECT_DOUBLE_EQ(map.of_vertex[1], 0.25 * factor);
  EXPECT_DOUBLE_EQ(map.of_vertex[2], 0.5 * factor);
  EXPECT_DOUBLE_EQ(map.of_vertex[3], factor);
  EXPECT_EQ(map.thickness(), (std::vector<double>{1.0, 2.0, 3.0, 5.0}));
}

TEST(ComputeKssm, WithLocalMaximaLeavesOutTheGlobalOne) {
  const HandMade made;
  const KssmMap map =
      compute_kssm(made.mesh, made.history, made.graph, {.suppression = Suppression::LocalMaxima});
  // The only strict local maximum is the global one: nothing is suppressed.
  EXPECT_DOUBLE_EQ(map.level_factor[0], 1.0);
}

TEST(ComputeKssm, WithLocalMaximaAveragesTheOthers) {
  HandMade made;
  // Two separate triangles: maxima 5 (global, D = 1) and 3 (D = 1/2).
  made.mesh.positions = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {5, 0, 0}, {0, 1, 0}, {0, 4, 0}};
  made.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  made.history.levels = {made.mesh.positions};
  const KssmMap map =
      compute_kssm(made.mesh, made.history, made.graph, {.suppression = Suppression::LocalMaxima});
  EXPECT_DOUBLE_EQ(map.level_factor[0], (1.0 - 0.5) * (1.0 - 0.5));
}

TEST(ComputeKssm, FromVelocitiesNeedsAStep) {
  HandMade made;
  made.history.levels.push_back(made.mesh.positions);
  for (Vec3& p : made.history.levels[1]) {
    p *= 0.5;  // vertex i moves by half its distance
  }
  const KssmMap map =
      compute_kssm(made.mesh, made.history, made.graph, {.kinematics = Kinematics::Velocity});
  // Velocities ½ (1, 2, 3, 5): the same shape as the displacement. No step led to level 0.
  EXPECT_EQ(map.level_factor, (std::vector<double>{0.0, 0.75 * 0.75}));
  EXPECT_EQ(map.levels_used, (std::vector<std::size_t>{1}));
  EXPECT_DOUBLE_EQ(map.of_vertex[2], 0.5 * 0.75 * 0.75);
}

// A vertex that a step leaves where it is has no velocity, however far the second curve is from the first.
TEST(ComputeKssm, MeasuresVelocitiesToOneCurve) {
  HandMade made;
  made.history.levels.push_back(made.mesh.positions);
  made.history.levels[1][3] *= 0.5;
  CurveGraph other = made.graph;
  for (Vec3& node : other.nodes) {
    node.x() += 0.3;
  }
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph,
                                   {.kinematics = Kinematics::Velocity}, {}, other);
  EXPECT_EQ(map.of_vertex[0], 0.0);
  EXPECT_EQ(map.of_vertex[1], 0.0);
  EXPECT_GT(map.of_vertex[3], 0.0);
}

TEST(ComputeKssm, TakesNothingFromAFlatLevel) {
  HandMade made;
  made.history.levels.push_back(std::vector<Vec3>(4, Vec3(1, 0, 0)));
  const KssmMap two = compute_kssm(made.mesh, made.history, made.graph);
  made.history.levels.pop_back();
  const KssmMap one = compute_kssm(made.mesh, made.history, made.graph);
  EXPECT_EQ(two.of_vertex, one.of_vertex);
  EXPECT_EQ(two.level_factor.back(), 0.0);
}

/// The strip contracted to a tenth, then to what is nearer to the graph than that of the strip meshed
/// anew is, whose levels are the same.
HandMade contracted_twice() {
  HandMade made;
  for (const double factor : {0.1, 0.01}) {
    made.history.levels.push_back(made.mesh.positions);
    for (Vec3& p : made.history.levels.back()) {
      p *= factor;
    }
  }
  made.history.second = {.mesh = made.mesh,
                         .levels = made.history.levels,
                         .component_of_vertex = {0, 0, 0, 0},
                         .here = made.history.levels,
                         .there = made.history.levels,
                         .remeshing = {Remeshing::Coarser}};
  return made;
}

TEST(ComputeKssm, LeavesOutLevelsThatAreTheSamplingOfTheCurve) {
  const HandMade made = contracted_twice();
  const CurveGraph other{.nodes = {{0.03, 0, 0}}, .edges = {}};
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph, {}, {}, other);
  EXPECT_EQ(map.levels_used, (std::vector<std::size_t>{0, 1}));
  EXPECT_DOUBLE_EQ(map.level_factor[1], 0.75 * 0.75);
  EXPECT_EQ(map.level_factor[2], 0.0);
  EXPECT_DOUBLE_EQ(map.of_vertex[3], map.level_factor[0] + map.level_factor[1]);
}

TEST(ComputeKssm, MeasuresTheInputToTheCurvesOfBothMeshes) {
  const HandMade made = contracted_twice();
  const CurveGraph other{.nodes = {{0.5, 1.0, 0}}, .edges = {}};
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph, {}, {}, other);
  const KssmMap alone = compute_kssm(made.mesh, made.history, made.graph);
  for (std::size_t v = 0; v < 4; ++v) {
    const double to_other = (made.mesh.positions[v] - other.nodes.front()).norm();
    EXPECT_DOUBLE_EQ(map.thickness()[v], 0.5 * (alone.thickness()[v] + to_other)) << v;
  }
  for (std::size_t level = 1; level < 3; ++level) {
    EXPECT_EQ(map.displacement[level], alone.displacement[level]);
  }
}

TEST(ComputeKssm, CountsALevelTheLessTheMoreTheOtherMeshDisagrees) {
  const HandMade made = contracted_twice();
  double before = 0.75 * 0.75;
  int in_part = 0;
  for (double shift = 0.0; shift < 0.3; shift += 0.01) {
    const CurveGraph other{.nodes = {{shift, 0, 0}}, .edges = {}};
    const KssmMap map = compute_kssm(made.mesh, made.history, made.graph, {}, {}, other);
    EXPECT_LE(map.level_factor[1], before + 1e-12) << shift;
    before = map.level_factor[1];
    in_part += before > 0.0 && before < 0.75 * 0.75 - 1e-12 ? 1 : 0;
  }
  EXPECT_EQ(before, 0.0);
  EXPECT_GE(in_part, 1);
}

TEST(ComputeKssm, LeavesOutLevelsThatTheOtherMeshHasOtherwise) {
  HandMade made = contracted_twice();
  std::swap(made.history.second.there[1][0], made.history.second.there[1][3]);
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph, {}, {}, made.graph);
  EXPECT_EQ(map.levels_used, std::vector<std::size_t>{0});  // noise stays: level 2 is finer still
}

/// Adds a large triangle to the second mesh that is, or nearly is, the first one there; far from the curve.
void add_untested(Remeshing remeshing, SecondMesh& second) {
  const std::uint32_t component = second.component_of_vertex.back() + 1;
  const auto first = static_cast<std::uint32_t>(second.mesh.positions.size());
  second.mesh.triangles.push_back({first, first + 1, first + 2});
  second.remeshing.push_back(remeshing);
  for (const Vec3& p : {Vec3(20, 0, 0), Vec3(0, 40, 0), Vec3(0, 0, 60)}) {
    second.mesh.positions.push_back(p);
    second.component_of_vertex.push_back(component);
    for (auto* levels : {&second.levels, &second.here, &second.there}) {
      for (auto& level : *levels) {
        level.push_back(p);
      }
    }
  }
}

TEST(ComputeKssm, WhatHasNoOtherMeshHasNoSayInWhichLevelsCount) {
  const HandMade made = contracted_twice();
  for (const double shift : {0.0, 0.03, 0.05, 0.3}) {
    const CurveGraph other{.nodes = {{shift, 0, 0}}, .edges = {}};
    const KssmMap alone = compute_kssm(made.mesh, made.history, made.graph, {}, {}, other);
    for (const Remeshing remeshing : {Remeshing::None, Remeshing::Hardly}) {
      HandMade beside = made;
      add_untested(remeshing, beside.history.second);
      const KssmMap map = compute_kssm(made.mesh, beside.history, made.graph, {}, {}, other);
      EXPECT_EQ(map.level_factor, alone.level_factor) << shift;
    }
  }
}

TEST(ComputeKssm, WhereNothingHasAnotherMeshCountsLevelsByTheAreaThatIsTooSmallForOne) {
  HandMade made = contracted_twice();
  const KssmMap all = compute_kssm(made.mesh, made.history, made.graph, {}, {}, made.graph);
  made.history.second.remeshing = {Remeshing::None};
  EXPECT_EQ(compute_kssm(made.mesh, made.history, made.graph, {}, {}, made.graph).level_factor,
            all.level_factor);
  add_untested(Remeshing::Hardly, made.history.second);
  const std::vector<double> area = vertex_areas(made.history.second.mesh);
  const double small = std::accumulate(area.begin(), area.begin() + 4, 0.0);
  const double whole = std::accumulate(area.begin(), area.end(), 0.0);
  const KssmMap some = compute_kssm(made.mesh, made.history, made.graph, {}, {}, made.graph);
  EXPECT_DOUBLE_EQ(some.level_factor[1], small / whole * all.level_factor[1]);
  EXPECT_EQ(some.level_factor[0], all.level_factor[0]);
  made.history.second.remeshing = {Remeshing::Hardly, Remeshing::Hardly};
  EXPECT_EQ(compute_kssm(made.mesh, made.history, made.graph, {}, {}, made.graph).levels_used,
            std::vector<std::size_t>{0});
}

TEST(ComputeKssm, CountsAllLevelsWhereNoOtherCurveIsGivenOrNoneIsAskedFor) {
  const HandMade made = contracted_twice();
  const CurveGraph other{.nodes = {{0.03, 0, 0}}, .edges = {}};
  const std::vector<std::size_t> all{0, 1, 2};
  EXPECT_EQ(compute_kssm(made.mesh, made.history, made.graph).levels_used, all);
  EXPECT_EQ(compute_kssm(made.mesh, made.history, made.graph, {.level_agreement = 0.0}, {}, other)
                .levels_used,
            all);
}

TEST(ComputeKssm, AlwaysCountsTheInput) {
  const HandMade made = contracted_twice();
  const CurveGraph far{.nodes = {{50, 0, 0}}, .edges = {}};
  EXPECT_EQ(compute_kssm(made.mesh, made.history, made.graph, {}, {}, far).levels_used,
            std::vector<std::size_t>{0});
}

TEST(ComputeKssm, OfASphereAroundItsCentreIsZero) {
  TriMesh mesh = test::sphere(3);
  ContractionHistory history{.levels = {mesh.positions}};
  for (int j = 0; j < 3; ++j) {
    history.levels.push_back(history.levels.back());
    for (Vec3& p : history.levels.back()) {
      p *= 0.3;
    }
  }
  const KssmMap map = compute_kssm(mesh, history, {.nodes = {{0, 0, 0}}, .edges = {}});
  EXPECT_THAT(map.of_vertex, testing::Each(0.0));
}

TEST(ComputeKssm, GivesIsolatedVerticesNothingAndLeavesThemOutOfTheScaling) {
  HandMade made;
  const KssmMap without = compute_kssm(made.mesh, made.history, made.graph);
  made.mesh.positions.emplace_back(1000, 0, 0);
  made.mesh.positions.emplace_back(0, 0, 0);
  made.history.levels = {made.mesh.positions};
  KssmMap with = compute_kssm(made.mesh, made.history, made.graph);
  EXPECT_EQ(with.of_vertex[4], 0.0);
  EXPECT_EQ(with.of_vertex[5], 0.0);
  with.of_vertex.resize(4);
  EXPECT_EQ(with.of_vertex, without.of_vertex);
}

TEST(ComputeKssm, CanWeighTheMeanByArea) {
  HandMade made;
  // A second triangle a hundred times as large, far less displaced than its share of vertices.
  made.mesh.positions = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 20, 0}, {20, 0, 0}};
  made.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  made.history.levels = {made.mesh.positions};
  const KssmOptions by_area{.area_weighted_mean = true};
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph, by_area);
  const std::vector<double> expected =
      test::direct_kssm(made.mesh, made.history, made.graph, by_area);
  const KssmMap by_vertex = compute_kssm(made.mesh, made.history, made.graph);
  EXPECT_GT(std::abs(map.level_factor[0] - by_vertex.level_factor[0]), 0.01);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    EXPECT_NEAR(map.of_vertex[v], expected[v], 1e-14);
  }
}

TEST(LevelSummand, OfAllLevelsMakesTheMap) {
  HandMade made;
  made.mesh.positions.emplace_back(40, 0, 0);  // isolated
  made.history.levels = {made.mesh.positions, made.mesh.positions, made.mesh.positions};
  made.history.levels[1][1] = {0, 0.5, 0};
  made.history.levels[2][3] = {0.25, 0, 0};
  for (const Kinematics kinematics : {Kinematics::Displacement, Kinematics::Velocity}) {
    const KssmMap map =
        compute_kssm(made.mesh, made.history, made.graph, {.kinematics = kinematics});
    std::vector<double> sum(made.mesh.positions.size(), 0.0);
    for (std::size_t level = 0; level < made.history.levels.size(); ++level) {
      const std::vector<double> summand = level_summand(made.mesh, map, level, kinematics);
      for (std::size_t v = 0; v < sum.size(); ++v) {
        sum[v] += summand[v];
      }
      EXPECT_DOUBLE_EQ(*std::max_element(summand.begin(), summand.end()), map.level_factor[level]);
    }
    EXPECT_EQ(sum, map.of_vertex);
    EXPECT_GE(map.levels_used.size(), 2U);
  }
}

TEST(LevelSummand, RefusesALevelThatTheMapHasNot) {
  const HandMade made;
  const KssmMap map = compute_kssm(made.mesh, made.history, made.graph);
  EXPECT_THROW(level_summand(made.mesh, map, 1, Kinematics::Displacement), InvalidInput);
}

TEST(ComputeKssm, RefusesAnotherMeshsHistory) {
  HandMade made;
  made.mesh.positions.emplace_back(0, 0, 0);
  EXPECT_THROW(compute_kssm(made.mesh, made.history, made.graph), InvalidInput);
}

TEST(ComputeKssm, RefusesCoordinatesThatItCannotComputeWith) {
  HandMade made;
  for (Vec3& p : made.mesh.positions) {
    p *= 1e62;
  }
  EXPECT_THROW(compute_kssm(made.mesh, made.history, made.graph), InvalidInput);
}

TEST(ComputeKssm, RefusesAGraphWithoutNodes) {
  const HandMade made;
  EXPECT_THROW(compute_kssm(made.mesh, made.history, CurveGraph{}), InvalidInput);
}

TEST(ComputeKssm, StopsOnRequest) {
  const HandMade made;
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(compute_kssm(made.mesh, made.history, made.graph, {}, {.stop = source.get_token()}),
               Cancelled);
}

TEST(ComputeKssm, OfASkeletonMeasuresToItsCurves) {
  HandMade made;
  const CurveGraph other{.nodes = {{1, 1, 0}}, .edges = {}};
  const Skeleton skeleton{.curve = made.graph, .other_curve = other};
  const KssmMap map = compute_kssm(made.mesh, made.history, skeleton);
  const KssmMap by_hand = compute_kssm(made.mesh, made.history, made.graph, {}, {}, other);
  EXPECT_EQ(map.of_vertex, by_hand.of_vertex);
  EXPECT_EQ(map.displacement, by_hand.displacement);
  EXPECT_NE(map.of_vertex, compute_kssm(made.mesh, made.history, made.graph).of_vertex);
  EXPECT_THROW(compute_kssm(made.mesh, made.history, Skeleton{}), InvalidInput);
}

}  // namespace
}  // namespace vantage
