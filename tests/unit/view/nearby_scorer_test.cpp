// SPDX-License-Identifier: MIT
#include "view/nearby_scorer.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

class NearbyScores : public testing::Test {
 protected:
  /// A direction and the ring of six around it, 1° away.
  [[nodiscard]] static std::vector<Vec3> around(const Vec3& middle) {
    std::vector<Vec3> directions = ring_around(middle, 1.0 * kRadPerDeg);
    directions.insert(directions.begin(), middle);
    return directions;
  }

  TriMesh mesh = test::torus(1.0, 0.4, 200, 60);
  VertexVisibility visibility{mesh, {FaceSides::Front}};
  std::vector<double> significance = [this] {
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) {
      values.push_back(1.0 + p.x() * p.x() + 0.5 * p.z());
    }
    return values;
  }();
  ScoringCamera camera{.sphere = {Vec3::Zero(), 2.8}};
  ViewScorer exact{visibility, significance, camera};
  Vec3 middle = Vec3(0.6, 0.2, 0.3).normalized();
  std::vector<Vec3> inside = ring_around(middle, 0.4 * kRadPerDeg);
};

TEST_F(NearbyScores, AreExactWhereTheyAreAskedFor) {
  NearbyScorer scorer(visibility, significance, camera);
  EXPECT_EQ(scorer.score_all(inside, {}), exact.score_all(inside));
}

TEST_F(NearbyScores, AreNearlyExactInTheMidstOfOthers) {
  NearbyScorer scorer(visibility, significance, camera);
  const std::vector<double> scores = exact.score_all(inside);
  const std::vector<double> nearby = scorer.score_amid({around(middle)}, inside, {});
  const double apart = std::abs(scores[0] - exact.score(around(middle)[1]));
  ASSERT_GT(apart, 0.0);  // so that there is something to tell
  for (std::size_t i = 0; i < inside.size(); ++i) {
    EXPECT_NEAR(nearby[i], scores[i], 1e-4 * scores[i]);
  }
}

TEST_F(NearbyScores, OfTheOthersThemselvesAreExact) {
  NearbyScorer scorer(visibility, significance, camera);
  const std::vector<Vec3> others = around(middle);
  const std::vector<double> nearby = scorer.score_amid({others}, others, {});
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_NEAR(nearby[i], exact.score(others[i]), 1e-12 * exact.total());
  }
}

TEST_F(NearbyScores, OfANarrowerCircleAreThoseOfTheWiderOne) {
  // What is disputed amid the wider circle is asked exactly, and of the narrower one's by all.
  NearbyScorer scorer(visibility, significance, camera);
  std::vector<Vec3> narrow = ring_around(middle, 0.4 * kRadPerDeg);
  narrow.insert(narrow.begin(), middle);
  const std::vector<Vec3> close = ring_around(middle, 0.2 * kRadPerDeg);
  const std::vector<double> wide = scorer.score_amid({around(middle)}, close, {});
  const std::vector<double> scores = scorer.score_amid({around(middle), narrow}, close, {});
  const double apart = std::abs(scores[0] - exact.score(narrow[1]));
  ASSERT_GT(apart, 0.0);
  for (std::size_t i = 0; i < close.size(); ++i) {
    EXPECT_NEAR(scores[i], wide[i], 1e-4 * wide[i]);
  }
  // Outside of the narrower one they are the wider one's.
  EXPECT_EQ(scorer.score_amid({around(middle), narrow}, {&around(middle)[1], 1}, {}),
            scorer.score_amid({around(middle)}, {&around(middle)[1], 1}, {}));
}

TEST_F(NearbyScores, AreExactTooFarOut) {
  NearbyScorer scorer(visibility, significance, camera);
  const std::vector<Vec3> far = ring_around(middle, 5.0 * kRadPerDeg);
  EXPECT_EQ(scorer.score_amid({around(middle)}, far, {}), exact.score_all(far));
  // As far out as the ring's corners, but between two of them: somebody else may come into view there.
  const std::vector<Vec3> ring = around(middle);
  const std::vector<Vec3> between{
      (middle + 1.12 * (0.5 * (ring[1] + ring[2]) - middle)).normalized()};
  ASSERT_LT(angle_between(middle, between.front()), 0.98 * kRadPerDeg);
  EXPECT_EQ(scorer.score_amid({ring}, between, {}), exact.score_all(between));
}

TEST_F(NearbyScores, DependNeitherOnWhatWasScoredBeforeNorOnThreads) {
  NearbyScorer fresh(visibility, significance, camera);
  NearbyScorer used(visibility, significance, camera);
  used.score_all(around(middle), {});
  used.score_amid({around(-middle)}, ring_around(-middle, 0.01), {});
  EXPECT_EQ(fresh.score_amid({around(middle)}, inside, {.max_threads = 1}),
            used.score_amid({around(middle)}, inside, {.max_threads = 3}));
}

TEST_F(NearbyScores, AreTheSameWhetherTheyWereExpectedOrNot) {
  const std::vector<Circles> all = [&] {
    std::vector<Circles> circles;
    for (const Vec3& at : {middle, Vec3(-middle), Vec3(Vec3::UnitX())}) {
      circles.push_back({around(at)});
    }
    return circles;
  }();
  std::vector<Circles> narrower = all;
  for (Circles& circles : narrower) {
    std::vector<Vec3> ring = ring_around(circles.front().front(), 0.5 * kRadPerDeg);
    ring.insert(ring.begin(), circles.front().front());
    circles.push_back(ring);
  }
  narrower.push_back(narrower.front());  // one twice
  for (const int threads : {1, 3}) {
    NearbyScorer expecting(visibility, significance, camera);
    expecting.expect(all, {.max_threads = threads});
    expecting.expect(narrower, {.max_threads = threads});
    for (const Circles& circles : narrower) {
      const std::vector<Vec3> within = ring_around(circles.front().front(), 0.3 * kRadPerDeg);
      NearbyScorer fresh(visibility, significance, camera);
      EXPECT_EQ(expecting.score_amid(circles, within, {}), fresh.score_amid(circles, within, {}));
    }
  }
}

}  // namespace
}  // namespace vantage
