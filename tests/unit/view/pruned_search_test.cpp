// SPDX-License-Identifier: MIT
#include "view/pruned_search.h"

#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage {
namespace {

const Vec3 kHill = Vec3(0.3, 0.5, 0.8).normalized();

/// A smooth hill of height 1 on a plain of 0.4; counts what it is asked.
struct Hill {
  std::multiset<std::tuple<double, double, double>> asked{};

  static double value(const Vec3& d) { return 0.4 + 0.6 * std::exp(4.0 * (d.dot(kHill) - 1.0)); }

  ScoreBatch score() {
    return [this](const std::vector<Vec3>& directions) {
      std::vector<double> values;
      for (const Vec3& d : directions) {
        asked.insert({d.x(), d.y(), d.z()});
        values.push_back(value(d));
      }
      return values;
    };
  }
};

double even(const Vec3& /*direction*/) {
  return 1.0;
}

/// Strongly for +z: at most 1, and e⁻⁴ behind.
double toward_z(const Vec3& d) {
  return std::exp(2.0 * (d.z() - 1.0));
}

TEST(PrunedSearch, ClimbsAHillToWithinItsLastRing) {
  Hill hill;
  const FoundView found = pruned_search(hill.score(), 2.0, even, {});
  // The last ring of six is 2° wide; its best is never more than half of that, over cos 30°, away.
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_LT(std::acos(std::min(1.0, found.direction.dot(kHill))), 2.0 * degree);
  EXPECT_EQ(found.score, Hill::value(found.direction));
}

TEST(PrunedSearch, LeavesOutOnlyWhatCannotBeTheBest) {
  Hill all;
  Hill pruned;
  const FoundView without =
      pruned_search(all.score(), 1e9, toward_z, {});  // a bound that says nothing
  const FoundView with = pruned_search(pruned.score(), 1.0, toward_z, {});  // what the hill reaches
  EXPECT_EQ(without.direction, with.direction);
  EXPECT_LT(with.evaluations, 3 * without.evaluations / 4);
}

TEST(PrunedSearch, CountsEachDirectionOnce) {
  Hill hill;
  const FoundView found = pruned_search(hill.score(), 1.0, toward_z, {});
  EXPECT_EQ(found.evaluations + 1, hill.asked.size());  // the winner's pure score is asked again
}

TEST(PrunedSearch, WithoutAnySignificanceThePriorAloneDecides) {
  const ScoreBatch nothing = [](const std::vector<Vec3>& directions) {
    return std::vector<double>(directions.size(), 0.0);
  };
  const FoundView found = pruned_search(nothing, 0.0, toward_z, {});
  EXPECT_GT(found.direction.z(), 0.99);
}

TEST(PrunedSearch, StopsWhenAskedTo) {
  std::stop_source source;
  source.request_stop();
  RunContext run;
  run.stop = source.get_token();
  Hill hill;
  EXPECT_THROW(pruned_search(hill.score(), 1.0, even, run), Cancelled);
}

}  // namespace
}  // namespace vantage
