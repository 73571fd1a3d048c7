// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/view/search.h"

#include "support/worst.h"

namespace vantage {
namespace {

const Vec3 kPeak = Vec3(1, 2, -2) / 3.0;

/// A hill of height 2 at kPeak that falls to 0 opposite.
std::vector<double> hill(const std::vector<Vec3>& directions) {
  std::vector<double> scores;
  scores.reserve(directions.size());
  for (const Vec3& d : directions) {
    scores.push_back(1.0 + d.dot(kPeak));
  }
  return scores;
}

SearchOptions by_gradient(int starts, std::uint64_t seed = 0) {
  return {.strategy = SearchStrategy::Gradient, .starts = starts, .seed = seed};
}

TEST(GradientSearch, ClimbsAHillFromOneStart) {
  const FoundView best = search_view({hill, 2.0}, Goal::Best, by_gradient(1));
  // The last way that is tried is a quarter of a degree.
  EXPECT_GT(best.direction.dot(kPeak), std::cos(0.25 * 3.14159 / 180.0));
}

TEST(GradientSearch, GoesDownForTheWorst) {
  const FoundView worst = search_view({hill, 2.0}, Goal::Worst, by_gradient(1));
  EXPECT_LT(worst.score, 1e-4);
}

TEST(GradientSearch, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const FoundView a = search_view({hill, 2.0}, Goal::Best, by_gradient(1, 5));
  const FoundView b = search_view({hill, 2.0}, Goal::Best, by_gradient(1, 5));
  const FoundView c = search_view({hill, 2.0}, Goal::Best, by_gradient(1, 6));
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_NE(a.trace.front().direction, c.trace.front().direction);
}

TEST(GradientSearch, GetsStuckOnASmallHillUnlessItStartsOften) {
  // Beside the hill of 2 a steep one of 1.5 on the other side of the sphere.
  const ScoreBatch two_hills = [](const std::vector<Vec3>& directions) {
    std::vector<double> scores;
    for (const Vec3& d : directions) {
      const double c = d.dot(kPeak);
      scores.push_back(std::max(2.0 * std::max(0.0, c), 1.5 * std::max(0.0, -c)));
    }
    return scores;
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    least =
        test::smaller(least, search_view({two_hills, 2.0}, Goal::Best, by_gradient(1, seed)).score);
  }
  EXPECT_LT(least, 1.5001);
  EXPECT_GT(search_view({two_hills, 2.0}, Goal::Best, by_gradient(16)).score, 1.999);
}

TEST(GradientSearch, StopsWhereTheScoreIsFlatOrInfinite) {
  for (const double value : {1.0, std::numeric_limits<double>::infinity()}) {
    const ScoreBatch flat = [&](const std::vector<Vec3>& directions) {
      return std::vector<double>(directions.size(), value);
    };
    // Each start and its four probes.
    EXPECT_EQ(search_view({flat, 1.0}, Goal::Best, by_gradient(3)).evaluations, 3U * 5U);
  }
}

TEST(GradientSearch, NeedsAStart) {
  EXPECT_THROW(search_view({hill, 2.0}, Goal::Best, by_gradient(0)), InvalidInput);
}

}  // namespace
}  // namespace vantage
