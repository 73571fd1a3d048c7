// SPDX-License-Identifier: MIT
#include "view/ascent.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

/// Two cones whose tops are a degree from where climbs start.
class TwoHills : public testing::Test {
 protected:
  static constexpr double kSlope = 1.0 / kRadPerDeg;  // one a degree
  Vec3 first = Vec3::UnitX();
  Vec3 second = Vec3::UnitY();
  double lower = 0.0;  // by so much is the second

  [[nodiscard]] double height(const Vec3& d) const {
    return 100.0 +
           std::max(-kSlope * angle_between(d, first), -kSlope * angle_between(d, second) - lower);
  }

  /// How many directions are scored, from a degree beside both tops.
  std::size_t scored(double hope, double noise) {
    const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
      std::vector<double> scores;
      scores.reserve(directions.size());
      for (const Vec3& d : directions) {
        scores.push_back(height(d));
      }
      return scores;
    };
    Evaluator exact(score);
    Effort effort{};
    effort.to_best = {.given_up = 0.0, .places = {2, 1, 0, 0, 0}, .hope = hope};
    const Guides guides{exact, exact, effort};
    std::vector<Candidate> tops;
    for (const Vec3& top : {first, second}) {
      const Vec3 beside_it = top.unitOrthogonal();  // where a ring has one of its places
      const Vec3 beside = (top + std::tan(kRadPerDeg) * beside_it).normalized();
      tops.push_back({beside, height(beside)});
    }
    const Candidate found = climb_hills(guides, Goal::Best, tops, noise, {});
    EXPECT_LT(angle_between(found.direction, lower < 0.0 ? second : first), 0.5 * kRadPerDeg);
    return exact.trace().size();
  }
};

TEST_F(TwoHills, TheLowerIsClimbedWhereItMayHopeToBecomeTheHighest) {
  lower = 0.2;
  const std::size_t one = scored(0.0, 1.0);
  // The first has gained one by then: the second would have to gain 1.2.
  EXPECT_EQ(scored(1.1, 1.0), one);
  EXPECT_GT(scored(1.3, 1.0), one + 6);
  EXPECT_EQ(scored(1.3, 0.5), one);
  EXPECT_GT(scored(0.0, 0.0), one + 6);  // where noise is not known, all are climbed
}

TEST_F(TwoHills, TheSecondWinsWhereItEndsHigher) {
  lower = -0.5;
  scored(2.0, 1.0);
}

}  // namespace
}  // namespace vantage
