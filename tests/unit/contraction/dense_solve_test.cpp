// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "contraction/component_contraction.h"
#include "contraction/step_solver.h"
#include "support/dense_oracles.h"
#include "support/named_mesh.h"
#include "support/shapes.h"
#include "support/worst.h"

/// \file
/// The contraction against a second implementation: dense, in long double, by a QR factorisation of
/// the least-squares system itself.

namespace vantage {
namespace {

using test::NamedMesh;

/// Brings the enclosing sphere to diameter 2 around the origin.
TriMesh scaled(TriMesh mesh) {
  const Sphere sphere = enclosing_sphere(mesh.positions);
  for (Vec3& p : mesh.positions) {
    p = (p - sphere.centre) * (2.0 / sphere.diameter);
  }
  return mesh;
}

std::vector<NamedMesh> small_shapes() {
  return {{"Sphere", scaled(test::sphere(2))},
          {"Torus", scaled(test::torus(1.0, 0.35, 16, 8))},
          {"Cylinder", scaled(test::cylinder(0.3, 3.0, 10, 12))},
          {"OpenCylinder", scaled(test::open_cylinder(0.3, 3.0, 10, 14))},
          {"Box", scaled(test::box(1.0, 2.0, 3.0, 4))},
          {"YOfTubes", scaled(test::y_of_tubes(0.35, 9))}};
}

class Against : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(Against, TheFirstStepAgreesWithADenseLeastSquaresSolve) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionOptions options;
  const ComponentHistory history = contract_component(mesh, options, {});
  ASSERT_GE(history.levels.size(), 2U);
  const auto weights = test::step_weights(mesh, mesh.positions, 0, options);
  const test::DenseMatrix expected = test::dense_step(mesh, weights, options.diagonal_limit);
  double squared_error = 0.0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 x = expected.row(static_cast<Eigen::Index>(v)).transpose().cast<double>();
    squared_error += (history.levels[1][v] - x).squaredNorm();
  }
  const double error = std::sqrt(squared_error) / static_cast<double>(expected.norm());
  RecordProperty("relative_error", std::to_string(error * 1e15) + "e-15");
  EXPECT_LE(error, 1e-9);
}

TEST_P(Against, EveryLaterStepSolvesItsSystemToRounding) {
  const TriMesh& mesh = GetParam().mesh;
  const ContractionOptions options;
  const ComponentHistory history = contract_component(mesh, options, {});
  ASSERT_EQ(history.summary.regularised_steps, 0);
  double worst = 0.0;
  for (std::size_t j = 0; j + 1 < history.levels.size(); ++j) {
    const TriMesh now{.positions = history.levels[j], .triangles = mesh.triangles};
    const auto weights = test::step_weights(mesh, now.positions, static_cast<int>(j), options);
    const double error =
        test::backward_error(now, history.levels[j + 1], weights, options.diagonal_limit);
    worst = test::larger(worst, error);
    EXPECT_LE(error, 1e-12) << "step " << j + 1;
  }
  RecordProperty("worst_backward_error", std::to_string(worst * 1e15) + "e-15");
}

TEST_P(Against, TheReportedShrinkageIsTheMeanAreaRatio) {
  const TriMesh& mesh = GetParam().mesh;
  const ComponentHistory history = contract_component(mesh, {}, {});
  for (std::size_t j = 0; j < history.levels.size(); ++j) {
    double sum = 0.0;
    for (const double ratio : test::dense_area_ratios(mesh, history.levels[j])) {
      sum += ratio;
    }
    EXPECT_NEAR(history.shrinkage[j], sum / static_cast<double>(mesh.positions.size()), 1e-10);
  }
}

TEST_P(Against, ASolverThatHasBeenUsedGivesTheSameLevels) {
  const TriMesh& mesh = GetParam().mesh;
  const EvenShares shares = even_shares(mesh);
  StepSolver solver(mesh, shares);
  using enum StepWeights;
  for (const StepWeights weights : {AsDefined, ForSlivers, AsDefined, ForSlivers}) {
    const ComponentHistory alone = contract_component(mesh, {}, {}, shares, weights);
    const ComponentHistory again = contract_component(mesh, {}, {}, shares, weights, solver);
    EXPECT_EQ(again.levels, alone.levels) << static_cast<int>(weights);  // to the bit
  }
}

INSTANTIATE_TEST_SUITE_P(DenseOracle, Against, ::testing::ValuesIn(small_shapes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace vantage
