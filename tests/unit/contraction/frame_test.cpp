// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/measures.h"

#include "contraction/component_contraction.h"
#include "support/dense_oracles.h"
#include "support/shapes.h"

/// \file
/// The frame a component is contracted in: what ContractionScaling says, and nothing but that.

namespace vantage {
namespace {

struct Frame {
  Vec3 centre = Vec3::Zero();
  double factor = 1.0;

  [[nodiscard]] TriMesh of(TriMesh mesh) const {
    for (Vec3& p : mesh.positions) {
      p = (p - centre) * factor;
    }
    return mesh;
  }
};

/// Tubes of different lengths: the sphere's centre is not that of the box.
TriMesh lopsided() {
  TriMesh mesh = test::y_of_tubes(0.35, 9);
  for (Vec3& p : mesh.positions) {
    p.x() *= p.x() > 0.0 ? 2.5 : 1.0;
  }
  return test::moved(mesh, 7.0, 0.4, Vec3(1, 2, 3), Vec3(3, -2, 1));
}

Frame frame_of(ContractionScaling scaling, const TriMesh& mesh) {
  if (scaling == ContractionScaling::Sphere) {
    const Sphere sphere = enclosing_sphere(mesh.positions);
    return {.centre = sphere.centre, .factor = 2.0 / sphere.diameter};
  }
  const Box box = bounding_box(mesh.positions);
  return {.centre = 0.5 * (box.low + box.high), .factor = 1.6 / box.longest_side()};
}

class FrameOf : public ::testing::TestWithParam<ContractionScaling> {};

TEST_P(FrameOf, TheFirstStepIsTheDenseSolutionInThatFrame) {
  const TriMesh mesh = lopsided();
  const ContractionOptions options{.method = ContractionMethod::Exact,
                                   .scaling = GetParam(),
                                   .weights = ContractionWeights::Vertex};
  const ContractionHistory history = contract(mesh, options);
  ASSERT_GE(history.level_count(), 1U);
  const Frame frame = frame_of(GetParam(), mesh);
  const TriMesh scaled = frame.of(mesh);
  const auto weights = test::step_weights(scaled, scaled.positions, 0, options);
  const test::DenseMatrix expected = test::dense_step(scaled, weights, options.diagonal_limit);
  const TriMesh step = frame.of({.positions = history.levels[1], .triangles = {}});
  double squared_error = 0.0;
  for (std::size_t v = 0; v < step.positions.size(); ++v) {
    const Vec3 x = expected.row(static_cast<Eigen::Index>(v)).transpose().cast<double>();
    squared_error += (step.positions[v] - x).squaredNorm();
  }
  EXPECT_LE(std::sqrt(squared_error), 1e-9 * static_cast<double>(expected.norm()));
}

TEST_P(FrameOf, EveryLevelIsThatOfTheScaledComponentBroughtBack) {
  const TriMesh mesh = lopsided();
  const ContractionOptions options{.method = ContractionMethod::Exact,
                                   .scaling = GetParam(),
                                   .weights = ContractionWeights::Vertex};
  const ContractionHistory history = contract(mesh, options);
  const Frame frame = frame_of(GetParam(), mesh);
  const ComponentHistory expected = contract_component(frame.of(mesh), options, {});
  ASSERT_EQ(history.levels.size(), expected.levels.size());
  for (std::size_t j = 0; j < history.levels.size(); ++j) {
    const TriMesh level = frame.of({.positions = history.levels[j], .triangles = {}});
    for (std::size_t v = 0; v < level.positions.size(); ++v) {
      // Late levels amplify the rounding of the scaling itself.
      EXPECT_LE((level.positions[v] - expected.levels[j][v]).norm(), 1e-9) << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scalings, FrameOf,
                         ::testing::Values(ContractionScaling::Sphere, ContractionScaling::Box),
                         [](const auto& instance) {
                           return instance.param == ContractionScaling::Sphere ? "Sphere" : "Box";
                         });

}  // namespace
}  // namespace vantage
