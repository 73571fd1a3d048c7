// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/significance/kssm.h"

#include "core/random.h"
#include "support/dense_oracles.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

// Each value passes a few dozen operations of double, on levels that span about their own size.
constexpr double kRelative = 1e-12;

/// A history whose levels shrink the mesh towards the origin by `factors`, each vertex by its own
/// share, so that no level is even and no two vertices tie.
ContractionHistory uneven_history(const TriMesh& mesh, const std::vector<double>& factors) {
  ContractionHistory history;
  history.levels.push_back(mesh.positions);
  Pcg32 random(5);
  for (const double factor : factors) {
    auto& level = history.levels.emplace_back(mesh.positions);
    for (Vec3& p : level) {
      p *= factor * (0.9 + 0.2 * random.uniform());
    }
  }
  return history;
}

/// Two spheres of different size and two vertices without faces, of which one is far away.
TriMesh two_shells_with_isolated_vertices() {
  const TriMesh small = test::moved(test::sphere(2), 0.5, 0.3, Vec3::UnitX(), Vec3::Zero());
  TriMesh mesh = test::together(test::sphere(1), small, Vec3(4.0, 1.0, 0.5));
  mesh.positions.insert(mesh.positions.begin() + 17, Vec3(100.0, 0.0, 0.0));
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      v += v >= 17 ? 1U : 0U;
    }
  }
  mesh.positions.emplace_back(0.1, 0.2, 0.3);
  return mesh;
}

/// A path and a node. The node is off the second sphere's centre: of vertices that tie, rounding
/// alone would decide which are strict local maxima.
CurveGraph path_and_node() {
  return {.nodes = {Vec3(-0.5, 0.0, 0.1), Vec3(0.4, 0.1, 0.0), Vec3(0.6, 0.5, -0.2),
                    Vec3(4.1, 1.07, 0.46)},
          .edges = {{0, 1}, {1, 2}}};
}

/// Largest difference over the largest value.
double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  double largest = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    difference = test::larger(difference, std::abs(a[v] - b[v]));
    largest = test::larger(largest, std::abs(b[v]));
  }
  return difference / largest;
}

class KssmFormula : public testing::TestWithParam<KssmOptions> {};

TEST_P(KssmFormula, IsWhatDirectEvaluationGivesForAnyHistoryAndGraph) {
  const TriMesh mesh = two_shells_with_isolated_vertices();
  const ContractionHistory history = uneven_history(mesh, {0.7, 0.5, 0.2, 0.1});
  const CurveGraph graph = path_and_node();
  const KssmMap map = compute_kssm(mesh, history, graph, GetParam());
  const std::vector<double> direct = test::direct_kssm(mesh, history, graph, GetParam());
  EXPECT_LT(relative_difference(map.of_vertex, direct), kRelative);
}

TEST_P(KssmFormula, FollowsTheVerticesWhenTheyAreRenumbered) {
  const TriMesh mesh = two_shells_with_isolated_vertices();
  const ContractionHistory history = uneven_history(mesh, {0.7, 0.3});
  const KssmMap map = compute_kssm(mesh, history, path_and_node(), GetParam());
  std::vector<std::uint32_t> old_of_new;
  const TriMesh shuffled = test::renumbered(mesh, 3, &old_of_new);
  ContractionHistory there = history;
  std::vector<double> expected;
  for (std::size_t v = 0; v < old_of_new.size(); ++v) {
    expected.push_back(map.of_vertex[old_of_new[v]]);
    for (std::size_t j = 0; j < history.levels.size(); ++j) {
      there.levels[j][v] = history.levels[j][old_of_new[v]];
    }
  }
  const KssmMap other = compute_kssm(shuffled, there, path_and_node(), GetParam());
  EXPECT_LT(relative_difference(other.of_vertex, expected), kRelative);
}

INSTANTIATE_TEST_SUITE_P(
    AllOptions, KssmFormula,
    testing::Values(KssmOptions{Suppression::Mean, Kinematics::Displacement, false, 0.0},
                    KssmOptions{Suppression::Mean, Kinematics::Displacement, false, 0.15},
                    KssmOptions{Suppression::Mean, Kinematics::Velocity, false, 0.15},
                    KssmOptions{Suppression::Mean, Kinematics::Displacement, false},
                    KssmOptions{Suppression::Mean, Kinematics::Displacement, true},
                    KssmOptions{Suppression::Mean, Kinematics::Velocity, false},
                    KssmOptions{Suppression::Mean, Kinematics::Velocity, true},
                    KssmOptions{Suppression::LocalMaxima, Kinematics::Displacement, false},
                    KssmOptions{Suppression::LocalMaxima, Kinematics::Displacement, true},
                    KssmOptions{Suppression::LocalMaxima, Kinematics::Velocity, false},
                    KssmOptions{Suppression::LocalMaxima, Kinematics::Velocity, true}));

/// Factor of level 0 of a sphere of diameter 2 with one vertex raised by `height`.
double factor_with_a_raised_vertex(double height) {
  TriMesh mesh = test::sphere(2);
  mesh.positions[5] *= 1.0 + height;
  ContractionHistory history;
  history.levels = {mesh.positions};
  return compute_kssm(mesh, history, {.nodes = {Vec3::Zero()}, .edges = {}}).level_factor.at(0);
}

TEST(KssmFlatLevel, SpansAtMostAMillionthOfTheDiameter) {
  EXPECT_EQ(factor_with_a_raised_vertex(0.95 * 1e-6 * 2.0), 0.0);
}

TEST(KssmFlatLevel, DoesNotSpanMoreThanAMillionthOfTheDiameter) {
  // All others are at the minimum to rounding, 1e-10 of the span: m̄ is nothing.
  EXPECT_NEAR(factor_with_a_raised_vertex(1.05 * 1e-6 * 2.0), 1.0, 1e-8);
}

/// Level factors of a raised sphere that halves its size at each step: level j spans 0.2 / 2^j, over
/// a diameter of about 2.1.
std::vector<double> factors_of_a_halved_sphere(double flat_level) {
  TriMesh mesh = test::sphere(2);
  mesh.positions[5] *= 1.2;
  ContractionHistory history;
  history.levels = {mesh.positions};
  for (int step = 0; step < 3; ++step) {
    history.levels.push_back(history.levels.back());
    for (Vec3& p : history.levels.back()) {
      p *= 0.5;
    }
  }
  const KssmOptions options{.flat_level = flat_level};
  return compute_kssm(mesh, history, {.nodes = {Vec3::Zero()}, .edges = {}}, options).level_factor;
}

TEST(KssmFlatLevel, LeavesOutLaterLevelsThatSpanLess) {
  // Spans over D are 0.095, 0.048, 0.024, 0.012.
  const std::vector<double> factors = factors_of_a_halved_sphere(0.03);
  EXPECT_GT(factors[1], 0.9);
  EXPECT_EQ(factors[2], 0.0);
  EXPECT_EQ(factors[3], 0.0);
}

TEST(KssmFlatLevel, NeverLeavesOutTheInput) {
  EXPECT_GT(factors_of_a_halved_sphere(1.0)[0], 0.9);
}

TEST(KssmFlatLevel, OfZeroKeepsAllThatIsNotRounding) {
  EXPECT_GT(factors_of_a_halved_sphere(0.0)[3], 0.9);
}

TEST(KssmFlatLevel, OutsideItsRangeIsRefusedByName) {
  try {
    factors_of_a_halved_sphere(2.0);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("flat-level"), std::string::npos);
  }
}

TEST(KssmHistory, OfALaterLevelOfAnotherSizeIsRefused) {
  const TriMesh mesh = test::sphere(0);
  ContractionHistory history;
  history.levels = {mesh.positions, std::vector<Vec3>(2, Vec3::Zero())};
  EXPECT_THROW(compute_kssm(mesh, history, path_and_node()), InvalidInput);
}

TEST(KssmHistory, WithoutLevelsIsRefused) {
  EXPECT_THROW(compute_kssm(test::sphere(0), ContractionHistory{}, path_and_node()), InvalidInput);
}

}  // namespace
}  // namespace vantage
