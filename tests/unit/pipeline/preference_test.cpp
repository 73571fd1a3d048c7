// SPDX-License-Identifier: MIT
#include "pipeline/preference.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// Its front and back are not mirror images.
TriMesh head() {
  TriMesh mesh = sphere(3);
  for (Vec3& p : mesh.positions) {
    p.z() *= p.z() > 0.0 ? 1.6 : 1.0;
  }
  return mesh;
}

/// It shows twice as much from behind as from +z.
double score_of(const Vec3& direction) {
  return direction.z() < 0.0 ? 0.8 : 0.4;
}

std::vector<double> scores_of(const std::vector<Vec3>& directions) {
  std::vector<double> scores;
  std::transform(directions.begin(), directions.end(), std::back_inserter(scores), score_of);
  return scores;
}

Vec3 preferred(const Preference& preference) {
  const std::vector<Vec3> sphere = direction_set(ViewSphereBase::Icosahedron, 3).directions;
  return *std::max_element(sphere.begin(), sphere.end(), [&](const Vec3& a, const Vec3& b) {
    return preference(a, score_of(a)) < preference(b, score_of(b));
  });
}

class PreferenceOfAHead : public testing::Test {
 protected:
  /// \param odds that it faces +z; else it faces the other way.
  [[nodiscard]] Preference facing(double odds) const {
    FrameChoice choice;
    choice.orientation.front.source = "shape";
    choice.orientation.front_odds = {odds, 0.0, 1.0 - odds, 0.0};
    Preference preference(shape_, choice, options_, 1.0);
    preference.weigh_fronts(scores_of);
    return preference;
  }

 private:
  ShapeAnalysis shape_ = prepare_surface(model_of(head()));
  ViewOptions options_{};
};

TEST_F(PreferenceOfAHead, GoesByTheOddsOfTheFrontAndNotByWhatThereIsToSee) {
  EXPECT_GT(preferred(facing(0.6)).z(), 0.3);
  EXPECT_LT(preferred(facing(0.4)).z(), -0.3);
}

TEST_F(PreferenceOfAHead, OfAFrontThatIsSureIsWhatItWas) {
  const Vec3 direction = Vec3(0.4, 0.4, 0.8).normalized();
  const double weighed = facing(1.0)(direction, 0.4);
  FrameChoice choice;
  choice.orientation.front.source = "shape";
  const ShapeAnalysis shape = prepare_surface(model_of(head()));
  const ViewOptions options;
  EXPECT_EQ(weighed, Preference(shape, choice, options, 1.0)(direction, 0.4));
}

}  // namespace
}  // namespace vantage::test
