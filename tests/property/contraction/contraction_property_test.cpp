// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/measures.h"

#include "support/many_threads.h"
#include "support/named_mesh.h"
#include "support/once.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

struct Shape : test::NamedMesh {
  /// How far levels may differ for inputs that differ by rounding, in diameters: late systems have
  /// condition 10¹² and more, but each step corrects its solution.
  double rounding = 1e-11;
};

std::vector<Shape> shapes() {
  return {{"Sphere", test::sphere(3)},
          {"Torus", test::torus(1.0, 0.3, 40, 16)},
          {"Box", test::box(1.0, 2.0, 3.0, 8)},
          {"Cylinder", test::cylinder(0.3, 3.0, 16, 32)},
          {"OpenCylinder", test::open_cylinder(0.3, 3.0, 16, 32)},
          {"YOfTubes", test::y_of_tubes(0.25, 32)},  // too fine to be refined first
          {"SphereAndTorus",
           test::together(test::sphere(2), test::torus(1.0, 0.3, 30, 12), Vec3(0, 0, 5))},
          {"Sheet", test::sheet(2.0, 1.0, 24), 1e-5},  // seven steps, each amplifies about tenfold
          {"FineSphere", test::sphere(4)},
          {"InsideOutBox", test::inside_out(test::box(1.0, 1.0, 4.0, 6))}};
}

/// The contraction of a shape as it is, computed once a process.
const ContractionHistory& contraction_as_is(const Shape& shape) {
  return test::once(shape.name, [&] { return contract(shape.mesh); });
}

class ContractionOf : public ::testing::TestWithParam<Shape> {};

/// Largest distance between corresponding points, over the diameter of the model.
double deviation(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double diameter) {
  double worst = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    worst = test::larger(worst, (a[v] - b[v]).norm() / diameter);
  }
  return worst;
}

TEST_P(ContractionOf, ShrinksStepByStepToASmallFractionOfItsArea) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionHistory& history = contraction_as_is(GetParam());
  for (const ComponentContraction& component : history.components) {
    EXPECT_GE(component.steps, 1);
  }
  const TriMesh last{.positions = history.levels.back(), .triangles = mesh.triangles};
  const double left = surface_area(last) / surface_area(mesh);
  RecordProperty("area_left", std::to_string(left));
  RecordProperty("levels", std::to_string(history.level_count()));
  EXPECT_LE(left, 0.1);
  const bool is_one = history.components.size() == 1;  // others end at different levels
  for (std::size_t j = 1; j < history.shrinkage.size(); ++j) {
    EXPECT_LE(history.shrinkage[j], history.shrinkage[j - 1]) << j;
    if (is_one && j > 1 && history.shrinkage[j - 1] <= 0.99) {  // by more than the tolerance
      EXPECT_GE(history.shrinkage[j - 1] - history.shrinkage[j], 0.01) << j;
    }
  }
}

TEST_P(ContractionOf, CommutesWithSimilarities) {
  const TriMesh& mesh = GetParam().mesh;
  const double diameter = enclosing_sphere(mesh.positions).diameter;
  const ContractionHistory& plain = contraction_as_is(GetParam());
  const Vec3 axis(1, 2, 3);
  double worst = 0.0;
  for (const double scale : {1e-8, 1e8}) {
    const Vec3 shift = scale * Vec3(3, -2, 1);
    const ContractionHistory other = contract(test::moved(mesh, scale, 0.7, axis, shift));
    ASSERT_EQ(other.levels.size(), plain.levels.size()) << scale;
    for (std::size_t j = 0; j < plain.levels.size(); ++j) {
      const TriMesh expected =
          test::moved({.positions = plain.levels[j], .triangles = {}}, scale, 0.7, axis, shift);
      worst = test::larger(worst, deviation(other.levels[j], expected.positions, scale * diameter));
    }
  }
  RecordProperty("worst_deviation", std::to_string(worst * 1e12) + "e-12 D");
  EXPECT_LE(worst, GetParam().rounding);
}

TEST_P(ContractionOf, DoesNotDependOnTheNumberingOfVertices) {
  const TriMesh& mesh = GetParam().mesh;
  const double diameter = enclosing_sphere(mesh.positions).diameter;
  const ContractionHistory& plain = contraction_as_is(GetParam());
  std::vector<std::uint32_t> old_of_new;
  const ContractionHistory other = contract(test::renumbered(mesh, 11, &old_of_new));
  ASSERT_EQ(other.levels.size(), plain.levels.size());
  for (std::size_t j = 0; j < plain.levels.size(); ++j) {
    std::vector<Vec3> expected;
    expected.reserve(old_of_new.size());
    for (const std::uint32_t v : old_of_new) {
      expected.push_back(plain.levels[j][v]);
    }
    EXPECT_LE(deviation(other.levels[j], expected, diameter), GetParam().rounding) << j;
  }
}

TEST_P(ContractionOf, DoesNotDependOnWhatElseIsInTheFile) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionHistory& alone = contraction_as_is(GetParam());
  const ContractionHistory joined =
      contract(test::together(mesh, test::torus(2.0, 0.1, 20, 10), Vec3(9, 9, 9)));
  const std::size_t common = std::min(alone.levels.size(), joined.levels.size());
  ASSERT_EQ(common, alone.levels.size());
  for (std::size_t j = 0; j < common; ++j) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      ASSERT_EQ(joined.levels[j][v], alone.levels[j][v]) << "level " << j << ", vertex " << v;
    }
  }
}

TEST_P(ContractionOf, HasTheSameBytesForAnyNumberOfThreads) {
  const ContractionHistory one = contract(GetParam().mesh, {}, {.max_threads = 1});
  EXPECT_EQ(contraction_as_is(GetParam()).levels, one.levels);  // by as many as there are cores
  const ContractionHistory three =
      test::with_many_threads([&] { return contract(GetParam().mesh, {}, {.max_threads = 3}); });
  EXPECT_EQ(one.levels, three.levels);
  EXPECT_EQ(one.shrinkage, three.shrinkage);
}

TEST_P(ContractionOf, SucceedsWithTheScalingOfThePaper) {
  const ContractionHistory history =
      contract(GetParam().mesh, {.scaling = ContractionScaling::Box});
  EXPECT_GE(history.level_count(), 1U);
  EXPECT_LE(history.shrinkage.back(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ContractionOf, ::testing::ValuesIn(shapes()),
                         [](const auto& instance) { return instance.param.name; });

/// Fine smooth surfaces begin to shrink step by step, and somewhere on that way by less than the tolerance.
TEST(ContractionOfFineSpheres, DoesNotEndBeforeItHasBegun) {
  for (const int cells : {14, 27, 42, 44, 46}) {
    const ContractionHistory history =
        contract(test::cube_sphere(cells),
                 {.method = ContractionMethod::Exact, .scaling = ContractionScaling::Box});
    EXPECT_LT(history.shrinkage.back(), 0.1) << cells;
  }
}

TEST(ContractionOfFineSpheres, DoesNotEndBeforeItHasBegunBySmallSteps) {
  const ContractionHistory history = contract(test::cube_sphere(44), {.contraction_growth = 1.5});
  EXPECT_LT(history.shrinkage.back(), 0.1);
}

/// Points spread evenly over the unit sphere along a spiral that turns by the golden angle.
std::vector<Vec3> spiral(std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * static_cast<double>(i);
    const double r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}

TEST(ContractionOfFineSpheres, DoesNotEndBeforeItHasBegunAsACloud) {
  for (const std::size_t count : {4000U, 6000U, 8000U}) {
    const std::vector<std::uint8_t> left_out(count, 0);
    const ContractionHistory history = contract_points(spiral(count), left_out, {}).history;
    EXPECT_LT(history.shrinkage.back(), 0.1) << count;
    for (std::size_t level = 1; level < history.shrinkage.size(); ++level) {
      EXPECT_LE(history.shrinkage[level], history.shrinkage[level - 1]) << count;
    }
  }
}

TEST(ContractionOfAY, TakesFewerStepsTheMoreAStepMustTakeOff) {
  const TriMesh mesh = test::y_of_tubes(0.25, 32);
  const std::size_t usual = contract(mesh).level_count();
  std::size_t before = usual;
  for (const double tolerance : {0.05, 0.2, 0.5, 0.8, 0.95, 1.0}) {
    const std::size_t levels = contract(mesh, {.shrinkage_tolerance = tolerance}).level_count();
    EXPECT_LE(levels, before) << tolerance;
    before = levels;
  }
  EXPECT_LT(before, usual);
}

TEST(ContractByProxy, TriesOtherWaysWhereTheProxyIsStuck) {
  const ContractionHistory history = contract(test::cylinder(1.0, 6.0, 11'000, 1));
  EXPECT_NE(history.components.front().strategy.find(", proxy "), std::string::npos);
  EXPECT_LT(history.shrinkage.back(), 0.1);  // 0.48 where it was left to be stuck
}

}  // namespace
}  // namespace vantage
