// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/view/search.h"

#include "view/climb.h"
#include "view/evaluator.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

using Field = std::function<double(const Vec3&)>;

ScoreBatch batch_of(Field field, std::size_t* asked = nullptr) {
  return [field = std::move(field), asked](const std::vector<Vec3>& directions) {
    std::vector<double> scores;
    scores.reserve(directions.size());
    for (const Vec3& d : directions) {
      scores.push_back(field(d));
    }
    if (asked != nullptr) {
      *asked += directions.size();
    }
    return scores;
  };
}

const Vec3 kHigh = Vec3(0.3, -0.5, 0.8).normalized();
const Vec3 kLow = Vec3(-0.7, 0.2, 0.1).normalized();

/// Some hills, the highest around kHigh, and a pit around kLow.
double hills(const Vec3& d) {
  const auto hill = [&](const Vec3& centre, double height, double width) {
    const double angle = angle_between(d, centre) / width;
    return height * std::exp(-angle * angle);
  };
  return 5.0 + hill(kHigh, 3.0, 0.4) + hill(Vec3::UnitX(), 2.7, 0.4) +
         hill(-Vec3::UnitZ(), 2.5, 0.3) - hill(kLow, 3.0, 0.5);
}

/// An estimate that is wrong by up to `error`, differently in each direction.
Field wrong_by(double error) {
  return [error](const Vec3& d) {
    return hills(d) + error * std::sin(91.0 * d.x() + 57.0 * d.y() + 71.0 * d.z());
  };
}

constexpr double kFoundRad = 0.2 * kRadPerDeg;

TEST(GlobalSearchByEstimates, FindsBothEndsWhereTheEstimateIsNearlyRight) {
  const FoundViews views =
      search_best_and_worst(batch_of(hills), 10.0, {}, {}, {.estimate = batch_of(wrong_by(0.05))});
  EXPECT_LT(angle_between(views.best.direction, kHigh), kFoundRad);
  EXPECT_LT(angle_between(views.worst.direction, kLow), kFoundRad);
}

TEST(GlobalSearchByEstimates, ScoresExactlyOnlyWhereTheEstimateLeads) {
  std::size_t exact = 0;
  std::size_t estimated = 0;
  const FoundViews views = search_best_and_worst(
      batch_of(hills, &exact), 10.0, {}, {}, {.estimate = batch_of(wrong_by(0.05), &estimated)});
  EXPECT_EQ(views.best.evaluations + views.worst.evaluations, exact);
  EXPECT_EQ(views.best.estimates + views.worst.estimates, estimated);
  EXPECT_LT(exact, 250U);
  EXPECT_GE(estimated, 162U);  // the whole sphere, 16° apart, …
  EXPECT_LT(estimated, 900U);  // … and closer where it matters: 642 are 8° apart
}

TEST(GlobalSearchByEstimates, FindsAHillThatTheEstimateRanksBelowManyThatAreNotThere) {
  // The estimate ranks the highest hill below seven others that are not there at all.
  const auto misled = [](const Vec3& d) {
    double value = hills(d) - 1.5 * std::exp(-std::pow(angle_between(d, kHigh) / 0.4, 2));
    for (int k = 0; k < 7; ++k) {
      const Vec3 ghost(std::cos(0.9 * k), std::sin(0.9 * k), 0.6 - 0.2 * k);
      value += 3.0 * std::exp(-std::pow(angle_between(d, ghost.normalized()) / 0.15, 2));
    }
    return value;
  };
  const FoundView best =
      search_view(batch_of(hills), 10.0, Goal::Best, {}, {}, {.estimate = batch_of(misled)});
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

TEST(GlobalSearchByEstimates, LearnsThatTheEstimateUnderratesAHill) {
  // By the estimate the highest hill is the second, and two places beat both that are nothing.
  const auto misled = [](const Vec3& d) {
    const auto bump = [&](const Vec3& centre, double width) {
      return std::exp(-std::pow(angle_between(d, centre) / width, 2));
    };
    return hills(d) - 0.5 * bump(kHigh, 0.4) + 4.0 * bump(Vec3::UnitY(), 0.15) +
           4.0 * bump(Vec3(0.0, 0.6, -0.8), 0.15);
  };
  const FoundView best =
      search_view(batch_of(hills), 10.0, Goal::Best, {}, {}, {.estimate = batch_of(misled)});
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

TEST(GlobalSearchByEstimates, ReportsExactScoresAndNoDirectionTwice) {
  const FoundView best =
      search_view(batch_of(hills), 10.0, Goal::Best, {}, {}, {.estimate = batch_of(wrong_by(0.3))});
  EXPECT_EQ(best.score, hills(best.direction));
  std::set<std::tuple<double, double, double>> seen;
  for (const SearchStep& step : best.trace) {
    EXPECT_EQ(step.score, hills(step.direction));
    EXPECT_TRUE(seen.insert({step.direction.x(), step.direction.y(), step.direction.z()}).second);
  }
}

TEST(GlobalSearchByEstimates, LearnsFromTheSearchBefore) {
  std::size_t estimated = 0;
  const SearchHints hints{.estimate = batch_of(wrong_by(0.3), &estimated)};
  const FoundViews both = search_best_and_worst(batch_of(hills), 10.0, {}, {}, hints);
  const std::size_t together = estimated;
  SearchHints taught = hints;
  for (const SearchStep& step : both.best.trace) {
    if (step.level == 0) {  // rings of climbs are not estimated
      taught.known.push_back({step.direction, wrong_by(0.3)(step.direction), step.score});
    }
  }
  const FoundView alone = search_view(batch_of(hills), 10.0, Goal::Worst, {}, {}, hints);
  estimated = 0;
  const FoundView after = search_view(batch_of(hills), 10.0, Goal::Worst, {}, {}, taught);
  EXPECT_EQ(after.direction, both.worst.direction);
  EXPECT_LT(angle_between(after.direction, kLow), kFoundRad);
  EXPECT_LT(estimated, alone.estimates - 50);
  EXPECT_LT(together, both.best.estimates + alone.estimates);
}

TEST(Evaluator, TellsWhatWasEstimatedAndScoredButForSome) {
  const ScoreBatch guess = batch_of(wrong_by(0.3));
  const ScoreBatch score = batch_of(hills);
  Evaluator estimates(guess);
  Evaluator exact(score);
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  estimates.scores({z, x, y}, 0);
  exact.scores({x, -x, y}, 0);
  const std::vector<KnownScore> known = known_scores(estimates, exact, std::vector<Vec3>{y});
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known.front().direction, x);
  EXPECT_EQ(known.front().estimate, wrong_by(0.3)(x));
  EXPECT_EQ(known.front().score, hills(x));
}

void expect_rings_of_1_and_half_a_degree(const Circles& circles) {
  double width = 1.001 * kRadPerDeg;
  for (const std::vector<Vec3>& circle : circles) {
    EXPECT_EQ(circle.size(), 7U);
    for (const Vec3& other : circle) {
      EXPECT_LT(angle_between(circle.front(), other), width);
    }
    width *= 0.5;
  }
  EXPECT_LE(circles.size(), 2U);
}

/// Nearby scores that are wrong by up to `error`, and how many were asked for.
ScoreNearby nearby_wrong_by(double error, std::size_t* asked) {
  return [error, asked](const Circles& circles, const std::vector<Vec3>& directions) {
    expect_rings_of_1_and_half_a_degree(circles);
    *asked += directions.size();
    return batch_of(wrong_by(error))(directions);
  };
}

TEST(GlobalSearchByNearbyScores, ClimbsByThemAndReportsAnExactScore) {
  std::size_t nearby = 0;
  const SearchHints without{.estimate = batch_of(wrong_by(0.05))};
  SearchHints with = without;
  with.nearby = nearby_wrong_by(0.0, &nearby);
  const FoundViews slow = search_best_and_worst(batch_of(hills), 10.0, {}, {}, without);
  const FoundViews found = search_best_and_worst(batch_of(hills), 10.0, {}, {}, with);
  EXPECT_LT(angle_between(found.best.direction, kHigh), kFoundRad);
  EXPECT_LT(angle_between(found.worst.direction, kLow), kFoundRad);
  EXPECT_DOUBLE_EQ(found.best.score, hills(found.best.direction));
  EXPECT_LT(found.best.evaluations + found.worst.evaluations + 40,
            slow.best.evaluations + slow.worst.evaluations);
  EXPECT_EQ(found.best.estimates + found.worst.estimates,
            slow.best.estimates + slow.worst.estimates + nearby);
}

TEST(GlobalSearchByNearbyScores, IsNotLedBelowWhatWasScored) {
  // Nearby scores that are nothing but wrong: the best ring of 1° that was scored stays.
  std::size_t nearby = 0;
  SearchHints hints{.estimate = batch_of(wrong_by(0.05))};
  hints.nearby = nearby_wrong_by(20.0, &nearby);
  const FoundView found = search_view(batch_of(hills), 10.0, Goal::Best, {}, {}, hints);
  EXPECT_GT(nearby, 0U);
  for (const SearchStep& step : found.trace) {
    EXPECT_LE(step.score, found.score);
  }
  EXPECT_DOUBLE_EQ(found.score, hills(found.direction));
}

TEST(Climb, ScoresNoPlaceOfItsLatticeTwice) {
  // Two steps of 1° up a slope: the second and the third ring share three places each with those
  // before.
  const Vec3 top = Vec3(0.2, 0.5, 0.7).normalized();
  Candidate summit{top};
  std::vector<Candidate> places{{ring_of(summit, 0.03)[1].direction}};
  const ScoreBatch score = batch_of([&](const Vec3& d) { return -angle_between(d, top); });
  Evaluator evaluator(score);
  places.front().score = evaluator.scores({places.front().direction}, 0).front();
  climb(places, Goal::Best, {0.015, 0.015}, evaluator, 1, {});
  EXPECT_LT(angle_between(places.front().direction, top), 0.0076);
  EXPECT_EQ(evaluator.trace().size(), 1U + 6U + 3U + 3U);
}

TEST(Climb, HasRingsOfTheirWidthOnEveryLattice) {
  Candidate place{Vec3(0.1, -0.9, 0.3).normalized()};
  for (const double width : {0.02, 0.01, 0.005}) {
    const std::vector<Candidate> ring = ring_of(place, width);
    ASSERT_EQ(ring.size(), 6U);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      EXPECT_NEAR(angle_between(ring[k].direction, place.direction), width, 1e-2 * width);
      EXPECT_NEAR(angle_between(ring[k].direction, ring[(k + 1) % 6].direction), width,
                  1e-2 * width);
    }
    place = ring[2];
  }
}

TEST(GlobalSearchByEstimates, IsNotUsedByTheOtherStrategies) {
  std::size_t estimated = 0;
  for (const SearchStrategy strategy : {SearchStrategy::Rapid, SearchStrategy::Exhaustive}) {
    search_view(batch_of(hills), 10.0, Goal::Best, {.strategy = strategy, .subdivisions = 1}, {},
                {.estimate = batch_of(hills, &estimated)});
  }
  EXPECT_EQ(estimated, 0U);
}

TEST(GlobalSearchByEstimates, ScoresBrinksThatTheEstimateDoesNotSee) {
  // A peak half a degree wide, far from all hills, that is not in the estimate.
  const Vec3 brink = Vec3(-0.4, -0.8, -0.2).normalized();
  const auto wall = [&](const Vec3& d) {
    return hills(d) + (angle_between(d, brink) < 0.5 * kRadPerDeg ? 6.0 : 0.0);
  };
  const FoundView blind =
      search_view(batch_of(wall), 10.0, Goal::Best, {}, {}, {.estimate = batch_of(hills)});
  EXPECT_LT(angle_between(blind.direction, kHigh), kFoundRad);
  const FoundView best = search_view(batch_of(wall), 10.0, Goal::Best, {}, {},
                                     {.estimate = batch_of(hills), .brinks = {brink}});
  EXPECT_LT(angle_between(best.direction, brink), 0.5 * kRadPerDeg);
}

TEST(GlobalSearch, LooksAtLandmarksThatTheFirstLookPassesBetween) {
  // A pit half a degree wide between the directions of the first look, as a part with flat sides
  // has where they are seen edge-on.
  const Vec3 pit = Vec3(0.11, 0.92, 0.23).normalized();
  const auto edge_on = [&](const Vec3& d) {
    return hills(d) - (angle_between(d, pit) < 0.5 * kRadPerDeg ? 4.0 : 0.0);
  };
  const FoundView blind = search_view(batch_of(edge_on), 10.0, Goal::Worst);
  EXPECT_GT(angle_between(blind.direction, pit), 1.0 * kRadPerDeg);
  const FoundView worst =
      search_view(batch_of(edge_on), 10.0, Goal::Worst, {}, {}, {.landmarks = {pit}});
  EXPECT_LT(angle_between(worst.direction, pit), 0.5 * kRadPerDeg);
}

}  // namespace
}  // namespace vantage
