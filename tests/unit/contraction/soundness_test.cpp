// SPDX-License-Identifier: MIT
#include "contraction/soundness.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

/// The mesh with its positions scaled along each axis.
TriMesh scaled(TriMesh mesh, const Vec3& factors) {
  for (Vec3& p : mesh.positions) {
    p = p.cwiseProduct(factors);
  }
  return mesh;
}

TEST(Soundness, KeepsAStepThatThinsATube) {
  const TriMesh tube = test::cylinder(0.2, 2.0, 12, 20);
  const TriMesh thin = scaled(tube, {0.1, 0.1, 0.95});
  EXPECT_EQ(Soundness(tube).flaw(tube, thin.positions, 1.0, 0.1, StepBound::BoxAndSphere),
            StepFlaw::None);
}

TEST(Soundness, KeepsAStepThatThinsATubeWiderThanItsFarthestPointsAreApart) {
  const TriMesh tube = test::cylinder(0.25, 4.0, 24, 48);
  const TriMesh wide = scaled(tube, {0.6, 0.6, 1.0});
  const TriMesh thin = scaled(tube, {0.02, 0.02, 0.95});
  EXPECT_EQ(Soundness(tube).flaw(wide, thin.positions, 0.6, 0.02, StepBound::BoxAndSphere),
            StepFlaw::None);
}

TEST(Soundness, RefusesToFlattenARingToALine) {
  const TriMesh ring = test::torus(1.0, 0.01, 60, 6);
  const TriMesh line = scaled(ring, {1.0, 0.01, 1.0});
  EXPECT_EQ(Soundness(ring).flaw(ring, line.positions, 1.0, 0.5, StepBound::BoxAndSphere),
            StepFlaw::Collapsed);
}

TEST(Soundness, RefusesAStepThatEnlarges) {
  const TriMesh tube = test::cylinder(0.2, 2.0, 12, 20);
  EXPECT_EQ(Soundness(tube).flaw(tube, tube.positions, 0.5, 0.51, StepBound::BoxAndSphere),
            StepFlaw::Rose);
}

TEST(Soundness, RefusesToRunACurveToAPoint) {
  const TriMesh tube = test::cylinder(0.2, 2.0, 12, 20);
  const TriMesh thin = scaled(tube, {0.1, 0.1, 1.0});
  const TriMesh speck = scaled(thin, Vec3::Constant(0.01));
  EXPECT_EQ(Soundness(tube).flaw(thin, speck.positions, 0.1, 1e-5, StepBound::BoxAndSphere),
            StepFlaw::Collapsed);
}

TEST(Soundness, LetsABallBecomeAPoint) {
  const TriMesh ball = test::sphere(2);
  const TriMesh point = scaled(ball, Vec3::Constant(0.01));
  EXPECT_EQ(Soundness(ball).flaw(ball, point.positions, 1.0, 1e-4, StepBound::BoxAndSphere),
            StepFlaw::None);
}

TEST(Soundness, RefusesAVertexThatFliesOff) {
  const TriMesh ball = test::sphere(2);
  TriMesh torn = scaled(ball, Vec3::Constant(0.5));
  torn.positions[0] = 3.0 * ball.positions[0];
  EXPECT_EQ(Soundness(ball).flaw(ball, torn.positions, 1.0, 0.9, StepBound::BoxAndSphere),
            StepFlaw::Grew);
}

}  // namespace
}  // namespace vantage
