// SPDX-License-Identifier: MIT
#include "view/view_likelihood.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/view/measure.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Likelihoods of views of a surface.
std::vector<double> likelihoods(const TriMesh& mesh, const std::vector<Vec3>& directions,
                                int level = 3, FaceSides which = FaceSides::Front,
                                Projection projection = Projection::Orthographic) {
  const std::vector<FaceSides> sides{which};
  MeasureSubject subject;
  subject.surface = &mesh;
  subject.sides = sides;
  subject.camera = {.sphere = enclosing_sphere(mesh.positions), .projection = projection};
  const ViewMeasurer measurer(subject, {find_measure("view-likelihood")}, level);
  return measurer.values(directions)[0];
}

/// −x log x to base 2.
double spread(double x) {
  return x > 0.0 ? -x * std::log2(x) : 0.0;
}

/// Jensen–Shannon divergence of what two views of a sphere see, whose directions are that far apart:
/// densities cos / π over the half spheres turned to them, by midpoints.
double divergence_of_sphere(double angle_rad) {
  constexpr int kSteps = 300;
  const Vec3 a = Vec3::UnitZ();
  const Vec3 b(std::sin(angle_rad), 0.0, std::cos(angle_rad));
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = -1.0 + (i + 0.5) * 2.0 / kSteps;
    const double r = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kSteps; ++j) {
      const double turn = (j + 0.5) * 2.0 * std::numbers::pi / kSteps;
      const Vec3 normal(r * std::cos(turn), r * std::sin(turn), z);
      const double p = std::max(0.0, normal.dot(a)) / std::numbers::pi;
      const double q = std::max(0.0, normal.dot(b)) / std::numbers::pi;
      sum += spread(0.5 * (p + q)) - 0.5 * (spread(p) + spread(q));
    }
  }
  return sum * 4.0 * std::numbers::pi / (kSteps * kSteps);
}

/// Largest angle between two views of a sphere that are alike, radians.
double reach_on_sphere() {
  double low = 0.0;
  double high = std::numbers::pi;
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    (divergence_of_sphere(middle) <= kAlike ? low : high) = middle;
  }
  return low;
}

TEST(ShareBelow, IsTheAreaWhereALinearFunctionIsBelow) {
  EXPECT_EQ(share_below(1.0, 2.0, 3.0, 0.5), 0.0);
  EXPECT_EQ(share_below(1.0, 2.0, 3.0, 3.5), 1.0);
  EXPECT_NEAR(share_below(0.0, 1.0, 1.0, 0.5), 0.25, 1e-15);
  EXPECT_NEAR(share_below(0.0, 0.0, 1.0, 0.5), 0.75, 1e-15);
  EXPECT_NEAR(share_below(3.0, 1.0, 2.0, 2.0), 0.5, 1e-15);
  EXPECT_EQ(share_below(0.2, 0.2, 0.2, 0.2), 1.0);
  EXPECT_EQ(share_below(0.0, 1.0, 2.0, 0.0), 0.0);
}

TEST(ViewLikelihood, OfASphereIsThatOfTheCapWhereViewsShareHalf) {
  const double reach = reach_on_sphere();
  const double expected = 0.5 * (1.0 - std::cos(reach));
  ASSERT_GT(expected, 0.1);
  for (const double likelihood : likelihoods(
           test::sphere(4), {Vec3::UnitZ(), Vec3(1, 2, 2) / 3.0, Vec3(0.6, -0.8, 0.0)}, 2)) {
    EXPECT_NEAR(likelihood, expected, 0.02 * expected);
  }
}

TEST(ViewLikelihood, OfAFlatSheetIsTheHalfSphereOnItsSide) {
  // From one side all views show the same shares; edge on nothing is seen, behind other faces are.
  TriMesh sheet;
  sheet.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  for (const double likelihood : likelihoods(sheet, {Vec3::UnitZ(), Vec3(0.0, 0.6, -0.8)})) {
    EXPECT_NEAR(likelihood, 0.5, 0.04);  // the border is known to a part of 8 degrees
  }
}

TEST(ViewLikelihood, IsGreatestWhereTheModelIsFlattest) {
  const std::vector<double> of =
      likelihoods(test::box(4.0, 3.0, 0.3, 6), {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()});
  EXPECT_GT(of[0], 3.0 * of[1]);
  EXPECT_GT(of[0], 3.0 * of[2]);
}

TEST(ViewLikelihood, IsNotLargerOnFinerFaces) {
  // Of parts of faces views know more than of whole ones, so they differ at least as much.
  const std::vector<Vec3> directions{Vec3::UnitZ(), Vec3(1, 2, 2) / 3.0, Vec3(2, -1, 2) / 3.0};
  const std::vector<double> coarse = likelihoods(test::box(3.0, 2.0, 1.0, 1), directions);
  const std::vector<double> fine = likelihoods(test::box(3.0, 2.0, 1.0, 8), directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_GT(coarse[i], 0.0);
    EXPECT_LE(fine[i], coarse[i] + 1e-6);
  }
}

TEST(ViewLikelihood, ChangesLittleWithTheSetAndWithoutAJumpBetweenItsViews) {
  const TriMesh ring = test::torus(1.0, 0.4, 24, 12);
  std::vector<Vec3> path;
  for (int i = 0; i <= 40; ++i) {
    const double angle = 0.5 * i * std::numbers::pi / 180.0;
    path.emplace_back(std::sin(angle), 0.1, std::cos(angle));
    path.back().normalize();
  }
  const auto view = Projection::Perspective;
  const std::vector<double> coarse = likelihoods(ring, path, 2, FaceSides::Front, view);
  const std::vector<double> fine = likelihoods(ring, path, 3, FaceSides::Front, view);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(coarse[i], fine[i], 0.05 * fine[i]) << i;
    EXPECT_NEAR(fine[i], fine[i > 0 ? i - 1 : 0], 0.04 * fine[i]) << i;
  }
}

TEST(ViewLikelihood, IsEstimatedByTheCoarserSet) {
  const TriMesh ring = test::torus(1.0, 0.4, 24, 12);
  const std::vector<FaceSides> sides{FaceSides::Front};
  MeasureSubject subject;
  subject.surface = &ring;
  subject.sides = sides;
  subject.camera = {.sphere = enclosing_sphere(ring.positions)};
  const std::vector<double> coarse =
      likelihoods(ring, direction_set(ViewSphereBase::Icosahedron, 3).directions, 2,
                  FaceSides::Front, Projection::Perspective);
  ViewMeasurer measurer(subject, {find_measure("view-likelihood")}, 3);
  const SetSurvey survey = measurer.survey_of(0);
  ASSERT_FALSE(survey.is_exact);
  EXPECT_EQ(survey.values, coarse);
}

TEST(ViewLikelihood, IsTheSameWithAndWithoutBoundsOfDistances) {
  for (const TriMesh& mesh : {test::torus(1.0, 0.4, 24, 12), test::box(4.0, 3.0, 0.3, 6)}) {
    const std::vector<FaceSides> sides{FaceSides::Front};
    MeasureSubject subject;
    subject.surface = &mesh;
    subject.sides = sides;
    subject.camera = {.sphere = enclosing_sphere(mesh.positions)};
    ViewMeasurer measurer(subject, {find_measure("view-likelihood")}, 3);
    MeasuredModel unbounded = measurer.model();
    ASSERT_FALSE(unbounded.divergences.empty());
    unbounded.divergences.clear();  // what bounds are made of
    const std::vector<double>& values = measurer.set_values()[0];
    for (std::size_t i = 0; i < values.size(); ++i) {
      SightTable sight = unbounded.set_sights[i];
      sight.faces = unbounded.set_views[i];
      EXPECT_EQ(values[i], view_likelihood(unbounded, sight)) << i;
    }
  }
}

TEST(ViewLikelihood, IsThatOfTheTurnedModelFromTheTurnedView) {
  // The turned set is another one: alike but for what lies between its views.
  const TriMesh box = test::box(3.0, 2.0, 1.0, 6);
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, -1).normalized());
  TriMesh turned = box;
  for (Vec3& p : turned.positions) {
    p = turn * p;
  }
  const Vec3 direction = Vec3(1, 2, 2) / 3.0;
  const double here = likelihoods(box, {direction})[0];
  EXPECT_NEAR(likelihoods(turned, {turn * direction})[0], here, 0.04 * here);
}

}  // namespace
}  // namespace vantage
