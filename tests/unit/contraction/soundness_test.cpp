// SPDX-License-Identifier: MIT
#include "contraction/soundness.h"

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

#include "support/named_mesh.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using test::NamedMesh;

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
  EXPECT_EQ(Soundness(tube).flaw(tube, thin.positions, 1.0, 0.1, true), StepFlaw::None);
}

TEST(Soundness, KeepsAStepThatThinsATubeWiderThanItsFarthestPointsAreApart) {
  const TriMesh tube = test::cylinder(0.25, 4.0, 24, 48);
  const TriMesh wide = scaled(tube, {0.6, 0.6, 1.0});
  const TriMesh thin = scaled(tube, {0.02, 0.02, 0.95});
  EXPECT_EQ(Soundness(tube).flaw(wide, thin.positions, 0.6, 0.02, true), StepFlaw::None);
}

TEST(Soundness, RefusesToFlattenARingToALine) {
  const TriMesh ring = test::torus(1.0, 0.01, 60, 6);
  const TriMesh line = scaled(ring, {1.0, 0.01, 1.0});
  EXPECT_EQ(Soundness(ring).flaw(ring, line.positions, 1.0, 0.5, true), StepFlaw::Collapsed);
}

TEST(Soundness, RefusesAStepThatEnlarges) {
  const TriMesh tube = test::cylinder(0.2, 2.0, 12, 20);
  EXPECT_EQ(Soundness(tube).flaw(tube, tube.positions, 0.5, 0.51, true), StepFlaw::Rose);
}

TEST(Soundness, RefusesToRunACurveToAPoint) {
  const TriMesh tube = test::cylinder(0.2, 2.0, 12, 20);
  const TriMesh thin = scaled(tube, {0.1, 0.1, 1.0});
  const TriMesh speck = scaled(thin, Vec3::Constant(0.01));
  EXPECT_EQ(Soundness(tube).flaw(thin, speck.positions, 0.1, 1e-5, true), StepFlaw::Collapsed);
}

TEST(Soundness, LetsABallBecomeAPoint) {
  const TriMesh ball = test::sphere(2);
  const TriMesh point = scaled(ball, Vec3::Constant(0.01));
  EXPECT_EQ(Soundness(ball).flaw(ball, point.positions, 1.0, 1e-4, true), StepFlaw::None);
}

TEST(Soundness, RefusesAVertexThatFliesOff) {
  const TriMesh ball = test::sphere(2);
  TriMesh torn = scaled(ball, Vec3::Constant(0.5));
  torn.positions[0] = 3.0 * ball.positions[0];
  EXPECT_EQ(Soundness(ball).flaw(ball, torn.positions, 1.0, 0.9, true), StepFlaw::Grew);
}

/// A box of long needles, as CAD programs write them: each side is a fan from one of its corners.
TriMesh fanned_box() {
  TriMesh mesh = test::box(2.0, 1.0, 0.5, 1);
  TriMesh fans{.positions = mesh.positions, .triangles = {}};
  for (const Triangle& t : mesh.triangles) {
    std::uint32_t previous = t[1];
    for (int k = 1; k <= 8; ++k) {
      std::uint32_t next = t[2];
      if (k < 8) {
        next = static_cast<std::uint32_t>(fans.positions.size());
        fans.positions.emplace_back(mesh.positions[t[1]] +
                                    k / 8.0 * (mesh.positions[t[2]] - mesh.positions[t[1]]));
      }
      fans.triangles.push_back({t[0], previous, next});
      previous = next;
    }
  }
  return fans;
}

std::vector<NamedMesh> sound_surfaces() {
  return {{"Cube", test::box(1, 1, 1, 1)},       {"CoarseBox", test::box(1, 0.5, 0.25, 2)},
          {"FannedBox", fanned_box()},           {"CoarseTorus", test::torus(1.0, 0.3, 12, 5)},
          {"CoarseY", test::y_of_tubes(0.3, 6)}, {"Plate", test::box(1.0, 1.0, 0.02, 6)},
          {"Sheet", test::sheet(1.0, 0.5, 5)},   {"FineSphere", test::sphere(5)}};
}

class SoundContraction : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(SoundContraction, NeverEnlargesTheSurface) {
  for (const ContractionMethod method : {ContractionMethod::Auto, ContractionMethod::Exact}) {
    const ContractionHistory history = contract(GetParam().mesh, {.method = method});
    ASSERT_GE(history.level_count(), 1U);
    for (std::size_t level = 1; level < history.shrinkage.size(); ++level) {
      EXPECT_LE(history.shrinkage[level], history.shrinkage[level - 1] + 1e-9) << level;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SoundContraction, ::testing::ValuesIn(sound_surfaces()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace vantage
