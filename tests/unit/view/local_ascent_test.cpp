// SPDX-License-Identifier: MIT
#include "view/local_ascent.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

const Vec3 kTop = Vec3(0.2, 0.5, 0.7).normalized();

/// A cone with its top at kTop, and the searches' view of it.
struct Cone {
  ViewObjective objective{[](const std::vector<Vec3>& directions) {
                            std::vector<double> scores;
                            for (const Vec3& d : directions) {
                              scores.push_back(-angle_between(d, kTop));
                            }
                            return scores;
                          },
                          1.0};
  ScoreMemo memo{objective.score};
  SearchTarget target{objective, Goal::Best, memo, memo};

  Candidate at(const Vec3& direction) { return {direction, target.values({direction}, 0).front()}; }
};

TEST(Ascent, EndsNearerToTheTopThanItsLastRing) {
  Cone cone;
  std::vector<Candidate> starts{cone.at(Vec3::UnitX()), cone.at(Vec3::UnitZ())};
  ascend(starts, {0.1, 0.001}, cone.target, 1, {});
  for (const Candidate& end : starts) {
    EXPECT_LT(angle_between(end.direction, kTop), 0.001);
  }
}

TEST(Ascent, ScoresNoPlaceOfItsLatticeTwice) {
  // From one step beside the top: the ring around the start holds the top to rounding; the ring
  // around that shares three places with the first, the start and its two neighbours in the ring.
  Cone cone;
  std::vector<Candidate> starts{cone.at(Vec3(kTop + 0.015 * kTop.unitOrthogonal()).normalized())};
  ascend(starts, {0.015, 0.015}, cone.target, 1, {});
  EXPECT_LT(angle_between(starts.front().direction, kTop), 0.0076);
  EXPECT_EQ(cone.memo.trace().size(), 1U + 6U + 3U);
}

TEST(Ascent, RecordsItsRoundsAsLevels) {
  Cone cone;
  std::vector<Candidate> starts{cone.at(kTop)};
  ascend(starts, {0.04, 0.01}, cone.target, 5, {});
  EXPECT_EQ(starts.front().direction, kTop);
  EXPECT_EQ(cone.memo.trace().back().level, 7);  // rings of 0.04, 0.02 and 0.01
  EXPECT_EQ(cone.memo.trace().size(), 1U + 3U * 6U);
}

TEST(Ascent, EndsWhereARingIsFlat) {
  // On the top the ring of 0.04 differs from it by nearly 0.04, that of 0.02 by atan 0.02.
  Cone cone;
  std::vector<Candidate> starts{cone.at(kTop)};
  ascend(starts, {.first_rad = 0.04, .last_rad = 0.001, .flat = 0.03}, cone.target, 1, {});
  EXPECT_EQ(cone.memo.trace().size(), 1U + 2U * 6U);
  EXPECT_NEAR(starts.front().spread, std::atan(0.02), 1e-12);
}

TEST(Ascent, GivesUpWhatCannotCatchUp) {
  // On the other side of the sphere a ring of 0.1 differs by 0.2 at most, and the top is 3 away.
  Cone cone;
  std::vector<Candidate> starts{cone.at(kTop), cone.at(-kTop)};
  ascend(starts, {.first_rad = 0.1, .last_rad = 0.01, .drops_losers = true}, cone.target, 1, {});
  EXPECT_EQ(starts[0].direction, kTop);
  EXPECT_EQ(cone.memo.trace().size(), 2U + 4U * 6U + 6U);
}

TEST(LargestApart, LeavesOutWhatIsNearALargerOne) {
  const Vec3 x = Vec3::UnitX();
  const Vec3 beside = Vec3(1.0, 0.05, 0.0).normalized();
  const std::vector<Candidate> few =
      largest_apart({{x, 1.0}, {beside, 2.0}, {Vec3::UnitY(), 0.5}, {Vec3::UnitZ(), 0.4}}, 2, 0.1);
  ASSERT_EQ(few.size(), 2U);
  EXPECT_EQ(few[0].direction, beside);
  EXPECT_EQ(few[1].direction, Vec3::UnitY());
}

TEST(LocalMaxima, OfEqualNeighboursAreTheLowestIndices) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 1);
  std::vector<double> values(set.directions.size(), 0.0);
  EXPECT_EQ(local_maxima(set, values).front(), 0U);
  values[17] = 1.0;
  EXPECT_EQ(local_maxima(set, values).front(), 17U);
}

}  // namespace
}  // namespace vantage
