// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/measures.h"

#include "support/named_mesh.h"
#include "support/shapes.h"

/// \file
/// Surfaces of a few faces, thin faces and extreme units.

namespace vantage {
namespace {

using test::NamedMesh;
using test::sphere_with_caps;

TriMesh tetrahedron() {
  return {.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
          .triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// A fan around the origin whose faces have sides of 1 and 1e-6.
TriMesh fan_of_needles() {
  TriMesh mesh{.positions = {Vec3::Zero()}, .triangles = {}};
  for (int i = 0; i <= 40; ++i) {
    mesh.positions.emplace_back(std::cos(1e-6 * i), std::sin(1e-6 * i), 0.0);
  }
  for (std::uint32_t i = 1; i <= 40; ++i) {
    mesh.triangles.push_back({0, i, i + 1});
  }
  return mesh;
}

std::vector<NamedMesh> surfaces() {
  return {{"Triangle", {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}}},
          {"NeedleOfOneToAMillion",
           {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}}, .triangles = {{0, 1, 2}}}},
          {"CapOfAMillionToOne",
           {.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}}, .triangles = {{0, 1, 2}}}},
          {"TwoTriangles",
           {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.3}},
            .triangles = {{0, 1, 2}, {2, 1, 3}}}},
          {"TwoTrianglesBackToBack",
           {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 1}}}},
          {"BowTie",
           {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0.5}},
            .triangles = {{0, 1, 2}, {0, 3, 4}}}},
          {"Tetrahedron", tetrahedron()},
          {"Cube", test::box(1, 1, 1, 1)},
          {"FanOfNeedles", fan_of_needles()}};
}

class SmallSurface : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(SmallSurface, IsContractedToLessAreaWithinItsBoxAndNeverGivenUpForWantOfASolution) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionHistory history = contract(mesh);
  EXPECT_NE(history.components.front().stop, ContractionStop::SolverFailed);
  const TriMesh last{.positions = history.levels.back(), .triangles = mesh.triangles};
  EXPECT_LT(surface_area(last), surface_area(mesh));
  const Vec3 first = bounding_box(mesh.positions).size();
  const double slack = 0.01 * enclosing_sphere(mesh.positions).diameter;
  for (const auto& level : history.levels) {
    for (const Vec3& p : level) {
      ASSERT_TRUE(p.allFinite());
    }
    const Vec3 now = bounding_box(level).size();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(now[axis], (1.2 * first[axis] + slack) * (1.0 + 1e-9));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SmallSurface, ::testing::ValuesIn(surfaces()),
                         [](const auto& instance) { return instance.param.name; });

class Caps : public ::testing::TestWithParam<double> {};

TEST_P(Caps, MakeItRegulariseAndSaySoAndSendNoVertexOutOfTheSphere) {
  const TriMesh mesh = sphere_with_caps(GetParam());
  const ContractionHistory history = contract(mesh);
  EXPECT_GT(history.components.front().regularised_steps, 0);
  EXPECT_EQ(history.warnings.size(), 2U);  // the step, and the copy that was contracted instead
  const Sphere sphere = enclosing_sphere(mesh.positions);
  for (const auto& level : history.levels) {
    for (const Vec3& p : level) {
      EXPECT_LE((p - sphere.centre).norm(), 1.2 * 0.5 * sphere.diameter);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, Caps, ::testing::Values(1e-6, 1e-9), [](const auto& instance) {
  return instance.param < 1e-7 ? "Billionth" : "Millionth";
});

TEST(SmallSurfaces, LeaveAVertexThatHangsOnADegenerateFaceWhereItIs) {
  for (const int around : {16, 240}) {  // as it is, and by a copy
    TriMesh mesh = test::torus(1.0, 0.3, around, 2 * around / 5);
    const Vec3 place(0.1, 0.2, 0.3);
    mesh.positions.push_back(place);
    mesh.triangles.push_back({0, 0, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
    const ContractionHistory history = contract(mesh);
    ASSERT_GE(history.level_count(), 1U);
    for (const auto& level : history.levels) {
      EXPECT_EQ(level.back(), place) << around;
    }
    EXPECT_EQ(history.component_of_vertex.back(), ContractionHistory::kIsolated);
  }
}

TEST(SmallSurfaces, ContractInUnitsFromTheTinyToTheHuge) {
  const TriMesh mesh = test::torus(1.0, 0.3, 16, 8);
  const auto expect_the_same = [&](const ContractionOptions& options,
                                   const std::vector<int>& exponents) {
    const ContractionHistory plain = contract(mesh, options);
    for (const int exponent : exponents) {  // exact: powers of two
      const double scale = std::ldexp(1.0, exponent);
      const ContractionHistory other =
          contract(test::moved(mesh, scale, 0.0, Vec3::UnitX(), Vec3::Zero()), options);
      ASSERT_EQ(other.levels.size(), plain.levels.size()) << exponent;
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_LE((other.levels.back()[v] / scale - plain.levels.back()[v]).norm(), 1e-9)
            << exponent;
      }
    }
  };
  expect_the_same({.method = ContractionMethod::Exact}, {-400, -100, 100, 400});
  expect_the_same({}, {-400});  // refined first
}

TEST(SmallSurfaces, AreNotSaidToHaveTakenAStepThatWasDiscarded) {
  const ContractionOptions coarse{.weights = ContractionWeights::Vertex,
                                  .attraction_limit = 1e9,
                                  .diagonal_limit = 1e12,
                                  .shrinkage_tolerance = 0.1};
  const ContractionHistory history = contract(test::box(1, 1, 3, 3), coarse);
  // The third step is sound only when taken more safely, and then takes off too little.
  ASSERT_EQ(history.components.front().steps, 2);
  EXPECT_TRUE(history.components.front().remedies.empty());
  EXPECT_TRUE(history.warnings.empty());
}

}  // namespace
}  // namespace vantage
