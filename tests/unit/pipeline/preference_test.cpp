// SPDX-License-Identifier: MIT
#include "pipeline/preference.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// What is behind scores twice what is in front does.
double more_behind(const Vec3& direction) {
  return direction.z() < 0.0 ? 1.0 : 0.5;
}

/// The largest preference among directions before, or behind, a shape whose front is either side.
double largest(const Preference& preference, bool is_behind) {
  double most = 0.0;
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 4).directions) {
    if ((d.z() < 0.0) == is_behind) {
      most = std::max(most, preference(d, more_behind(d)));
    }
  }
  return most;
}

TEST(Preference, LeavesItToTheShapeWhichSideIsTheFront) {
  // A box with a corner drawn out has no mirror plane.
  TriMesh mesh = box(1.0, 1.0, 1.0, 2);
  mesh.positions.front() += Vec3(-0.4, -0.3, -0.2);
  const Model model = model_of(mesh);
  const ShapeAnalysis shape = prepare_surface(model);
  FrameChoice choice;
  choice.orientation.front_odds = {0.6, 0.0, 0.4, 0.0};
  const ViewOptions options;
  const Preference preference(shape, choice, options, 1.0, [](const std::vector<Vec3>& directions) {
    std::vector<double> scores;
    for (const Vec3& d : directions) {
      scores.push_back(more_behind(d));
    }
    return scores;
  });
  // By the powers of the scores alone it would be one to a hundred and more.
  EXPECT_NEAR(largest(preference, false) / largest(preference, true), 0.6 / 0.4, 0.2);
}

}  // namespace
}  // namespace vantage::test
