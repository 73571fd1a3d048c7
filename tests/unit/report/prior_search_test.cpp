// SPDX-License-Identifier: MIT
#include "report/prior_search.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vantage::test {
namespace {

/// A score with a peak at +x and a lower one at +z; each direction counted.
struct Peaks {
  std::size_t calls = 0;

  ScoreBatch score() {
    return [this](const std::vector<Vec3>& directions) {
      std::vector<double> values;
      for (const Vec3& d : directions) {
        values.push_back(value(d));
      }
      calls += directions.size();
      return values;
    };
  }

  static double value(const Vec3& d) {
    return 2.0 + std::max(1.0 * std::exp(8.0 * (d.x() - 1.0)), 0.8 * std::exp(8.0 * (d.z() - 1.0)));
  }
};

ViewPrior toward_z() {
  return parse_prior(
      R"({"vantage_prior": 1, "lobes": [{"direction": [0, 0, 1], "weight": 1, "width_deg": 60}]})",
      "z.json");
}

TEST(PriorSearch, FindsTheLargestProductAndTheLeastPureScore) {
  Peaks peaks;
  const FoundViews pure = search_under_prior(peaks.score(), 3.0, no_prior(), {}, {}, {});
  const FoundViews found = search_under_prior(peaks.score(), 3.0, toward_z(), {}, {}, {});
  EXPECT_NEAR(pure.best.direction.x(), 1.0, 1e-6);
  EXPECT_NEAR(found.best.direction.z(), 1.0, 1e-6);
  EXPECT_EQ(found.worst.direction, pure.worst.direction);
  EXPECT_EQ(found.worst.score, pure.worst.score);
}

TEST(PriorSearch, GivesPureScoresBack) {
  Peaks peaks;
  const FoundViews found = search_under_prior(peaks.score(), 3.0, toward_z(), {}, {}, {});
  EXPECT_EQ(found.best.score, Peaks::value(found.best.direction));
  for (const SearchStep& step : found.best.trace) {
    ASSERT_EQ(step.score, Peaks::value(step.direction));
  }
}

TEST(PriorSearch, ScoresNoDirectionTwiceAndCountsEach) {
  Peaks peaks;
  const FoundViews found = search_under_prior(peaks.score(), 3.0, toward_z(), {}, {}, {});
  EXPECT_EQ(found.best.evaluations + found.worst.evaluations, peaks.calls);
}

}  // namespace
}  // namespace vantage::test
