// SPDX-License-Identifier: MIT
#include "vantage/view/scoring.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/spatial/directions.h"

#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

TEST(VisibleSum, RefusesAnotherNumberOfFlagsThanValues) {
  const std::vector<double> values{1.0, 2.0};
  EXPECT_EQ(visible_sum(values, std::vector<std::uint8_t>{0, 1}), 2.0);
  EXPECT_THROW((void)visible_sum(values, std::vector<std::uint8_t>{1}), InvalidInput);
  EXPECT_THROW((void)visible_sum(values, std::vector<std::uint8_t>{1, 1, 1}), InvalidInput);
}

TEST(ScoringCamera, StandsWhereTheSphereJustFillsTheFieldOfView) {
  const ScoringCamera camera{.sphere = {Vec3(1, 2, 3), 4.0}, .fov_y_deg = 60.0};
  // R = (D/2) / sin 30° = 2 / 0.5.
  EXPECT_DOUBLE_EQ(camera.distance(), 4.0);
  EXPECT_NEAR((camera.eye(Vec3::UnitX()) - Vec3(5, 2, 3)).norm(), 0.0, 1e-15);
}

TEST(ScoringCamera, TakesItsDistanceInSphereRadii) {
  const ScoringCamera camera{.sphere = {Vec3::Zero(), 4.0}, .distance_factor = 1.5};
  EXPECT_DOUBLE_EQ(camera.distance(), 3.0);
}

TEST(ScoringCamera, LooksAlongTheDirectionWhenOrthographic) {
  const ScoringCamera camera{.sphere = {Vec3(9, 9, 9), 4.0},
                             .projection = Projection::Orthographic};
  EXPECT_EQ(camera.viewpoint(Vec3::UnitY()).position, Vec3::UnitY());
}

/// A cube with significance 2^v at vertex v, so that a score names the vertices it counts.
class ScorerOfACube : public testing::Test {
 protected:
  ScorerOfACube() {
    for (std::size_t v = 0; v < 8; ++v) {
      significance.push_back(std::ldexp(1.0, static_cast<int>(v)));
    }
  }

  TriMesh cube = test::box(1.0, 1.0, 1.0, 1);
  VertexVisibility visibility{cube, {FaceSides::Front}};
  std::vector<double> significance{};
  ScoringCamera camera{.sphere = {Vec3(0.5, 0.5, 0.5), std::numbers::sqrt3}};
};

TEST_F(ScorerOfACube, SumsAllVerticesToTheTotal) {
  EXPECT_EQ(ViewScorer(visibility, significance, camera).total(), 255.0);
}

TEST_F(ScorerOfACube, SumsTheVerticesSeen) {
  double expected = 0.0;
  for (std::size_t v = 0; v < 8; ++v) {
    expected += cube.positions[v].x() == 1.0 ? significance[v] : 0.0;
  }
  EXPECT_EQ(ViewScorer(visibility, significance, camera).score(Vec3::UnitX()), expected);
}

TEST_F(ScorerOfACube, ScoresManyDirectionsLikeEachAloneOnAnyThreads) {
  const ViewScorer scorer(visibility, significance, camera);
  const auto directions = direction_set(ViewSphereBase::Icosahedron, 1).directions;
  std::vector<double> expected;
  expected.reserve(directions.size());
  for (const Vec3& d : directions) {
    expected.push_back(scorer.score(d));
  }
  for (const int threads : {1, 3}) {
    const auto scores = test::with_many_threads(
        [&] { return scorer.score_all(directions, {.max_threads = threads}); });
    EXPECT_EQ(scores, expected) << threads;
  }
}

TEST_F(ScorerOfACube, RefusesANegativeSignificance) {
  significance[3] = -1.0;
  EXPECT_THROW(ViewScorer(visibility, significance, camera), InvalidInput);
}

TEST_F(ScorerOfACube, RefusesASignificanceThatIsNotANumber) {
  significance[3] = std::nan("");
  EXPECT_THROW(ViewScorer(visibility, significance, camera), InvalidInput);
}

TEST_F(ScorerOfACube, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const ViewScorer scorer(visibility, significance, camera);
  EXPECT_THROW(static_cast<void>(scorer.score_all(std::vector<Vec3>(3, Vec3::UnitX()),
                                                  {.stop = source.get_token()})),
               Cancelled);
  EXPECT_THROW(static_cast<void>(scorer.score(Vec3::UnitX(), {.stop = source.get_token()})),
               Cancelled);
}

}  // namespace
}  // namespace vantage
