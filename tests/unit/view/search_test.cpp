// SPDX-License-Identifier: MIT
#include "vantage/view/search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stop_token>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/worst.h"

namespace vantage {
namespace {

/// Scores directions by a function of one.
template <class Function>
ScoreBatch scoring(const Function& function) {
  return [function](const std::vector<Vec3>& directions) {
    std::vector<double> scores;
    scores.reserve(directions.size());
    for (const Vec3& d : directions) {
      scores.push_back(function(d));
    }
    return scores;
  };
}

double height(const Vec3& d) {
  return 1.0 + d.z();
}

/// Three hills; the tallest, at peak(), is not the widest.
Vec3 peak() {
  return Vec3(0.3, -0.7, 0.45).normalized();
}

double three_hills(const Vec3& d) {
  const auto hill = [&](const Vec3& top, double tall, double steep) {
    return tall * std::exp(steep * (d.dot(top) - 1.0));
  };
  return hill(peak(), 1.0, 30.0) + hill(Vec3::UnitX(), 0.8, 5.0) + hill(-Vec3::UnitY(), 0.3, 3.0);
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

SearchOptions paper() {
  return {.strategy = SearchStrategy::Rapid,
          .base = ViewSphereBase::Cube,
          .subdivisions = 0,
          .epsilon = 0.1,
          .epsilon_is_fraction = false,
          .require_narrow_ring = false};
}

// By hand, for the score 1 + z on the cube, ε = 0.1 (s = 1/√3 = 0.5774):
// Start: the four corners with z = s tie at 1.5774; the first of them is a = (−s,−s,s), the
//   smallest corner of the square z = +, so that its ring is (−s,−s,−s), (−s,s,s), (s,−s,s) and,
//   along the diagonal, c = (s,s,s).
// Level 1, four new vertices. The diagonal's, m, has the opposite corners (−s,s,s) and (s,−s,s):
//   3/8 (a + c) + 1/8 (0, 0, 2s) = s (0, 0, 1), that is (0, 0, 1), score 2. Gain 0.4226: move to m.
// Level 2, six new vertices around m. Its neighbours are a, c and the new vertices of the square's
//   sides: p = (−1,0,1)/√2, (0,−1,1)/√2, q = (−1,3,3)/√19, (3,−1,3)/√19, because the side between
//   (−s,s,s) and c has the opposite corners a and (−s,s,−s):
//   3/8 (0,2s,2s) + 1/8 (−2s,0,0) = s/4 (−1,3,3). The new vertex nearest to m is that of edge mq,
//   with p and c opposite: 3/8 (m + q) + 1/8 (p + c) ∝ (−0.118, 0.382, 0.917), score 1.917.
//   Gain 0.083 < ε: keep m and stop after 8 + 4 + 6 evaluations.
TEST(RapidSearch, FollowsTheTraceComputedByHand) {
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, paper());
  std::vector<int> levels;
  for (const SearchStep& step : found.trace) {
    levels.push_back(step.level);
  }
  EXPECT_EQ(levels, (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2}));
  EXPECT_NEAR((found.direction - Vec3::UnitZ()).norm(), 0.0, 1e-15);
}

TEST(RapidSearch, HasTheSecondRingComputedByHand) {
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, paper());
  const Vec3 m = Vec3::UnitZ();
  const Vec3 p = Vec3(-1, 0, 1).normalized();
  const Vec3 q = Vec3(-1, 3, 3).normalized();
  const Vec3 c = Vec3(1, 1, 1).normalized();
  const Vec3 nearest = (3.0 * (m + q) + p + c).normalized();
  double best = 0.0;
  for (const SearchStep& step : found.trace) {
    best = step.level == 2 ? test::larger(best, step.score) : best;
  }
  EXPECT_NEAR(best, 1.0 + nearest.z(), 1e-15);
}

TEST(RapidSearch, UsesLoopsWeightsForItsFirstRing) {
  // The edge from a = (−,−,+) to (−,+,+): opposite are (+,+,+) in z = + and, in x = − (whose
  // diagonal runs from (−,−,−) to (−,+,+)), the corner (−,−,−).
  //   3/8 [(−,−,+) + (−,+,+)] + 1/8 [(+,+,+) + (−,−,−)] = 3/8 (−2, 0, 2): the direction (−1, 0, 1).
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, paper());
  const Vec3 expected = Vec3(-1, 0, 1).normalized();
  EXPECT_TRUE(std::any_of(found.trace.begin(), found.trace.end(), [&](const SearchStep& s) {
    return s.level == 1 && (s.direction - expected).norm() < 1e-15;
  }));
}

TEST(RapidSearch, StopsWhenARingGainsLessThanARawEpsilon) {
  SearchOptions options = paper();
  options.epsilon = 10.0;  // more than the whole range of the score
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, options);
  EXPECT_EQ(found.trace.back().level, 1);
  // The move to the ring's best happens before the stop.
  EXPECT_NEAR(found.score, 2.0, 1e-15);
}

TEST(RapidSearch, TakesEpsilonAsAFractionOfTheTotal) {
  SearchOptions options = paper();
  options.epsilon_is_fraction = true;
  // The first ring gains 0.4226: stopped by 0.1 of a total of 5, not by 0.1 of a total of 4.
  const auto last_level = [&](double total) {
    return search_view({scoring(height), total}, Goal::Best, options).trace.back().level;
  };
  EXPECT_EQ(last_level(5.0), 1);
  EXPECT_GT(last_level(4.0), 1);
}

TEST(RapidSearch, GoesOnToANarrowRingIfAsked) {
  SearchOptions options = paper();
  options.epsilon = 10.0;
  options.require_narrow_ring = true;
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, options);
  EXPECT_LT(degrees_between(found.trace.back().direction, found.direction), 2.0);
}

TEST(RapidSearch, EndsAtAThousandthOfADegreeWhateverEpsilon) {
  SearchOptions options = paper();
  options.epsilon = 0.0;
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Best, options);
  const double last = degrees_between(found.trace.back().direction, found.direction);
  EXPECT_LE(last, 0.001);
  EXPECT_GT(last, 0.00002);
}

TEST(RapidSearch, FindsTheWorstByTheSameRule) {
  SearchOptions options = paper();
  const FoundView found = search_view({scoring(height), 8.0}, Goal::Worst, options);
  // (−,−,−) is the first of the lowest corners; it is on the diagonal of z = − too.
  EXPECT_NEAR(found.score, 0.0, 1e-15);
}

TEST(RapidSearch, OfABlankMapIsTheFirstDirection) {
  const FoundView found = search_view({scoring([](const Vec3&) { return 0.0; }), 0.0}, Goal::Best,
                                      {.strategy = SearchStrategy::Rapid});
  EXPECT_EQ(found.direction, direction_set(ViewSphereBase::Icosahedron, 3).directions[0]);
}

TEST(ExhaustiveSearch, IsALinearScan) {
  const auto directions = direction_set(ViewSphereBase::Icosahedron, 4).directions;
  const auto best = std::max_element(
      directions.begin(), directions.end(),
      [](const Vec3& a, const Vec3& b) { return three_hills(a) < three_hills(b); });
  const FoundView found = search_view({scoring(three_hills), 1.0}, Goal::Best,
                                      {.strategy = SearchStrategy::Exhaustive, .subdivisions = 4});
  EXPECT_EQ(found.direction, *best);
  EXPECT_EQ(found.evaluations, 2562U);
}

TEST(ExhaustiveSearch, GivesTiesToTheLowestIndex) {
  const auto flat = scoring([](const Vec3& d) { return d.z() > 0.0 ? 1.0 : 0.5; });
  const auto directions = direction_set(ViewSphereBase::Icosahedron, 2).directions;
  const auto first =
      std::find_if(directions.begin(), directions.end(), [](const Vec3& d) { return d.z() > 0.0; });
  const FoundView found = search_view({flat, 1.0}, Goal::Best,
                                      {.strategy = SearchStrategy::Exhaustive, .subdivisions = 2});
  EXPECT_EQ(found.direction, *first);
}

TEST(GlobalSearch, FindsTheTallestOfSeveralHills) {
  const FoundView found = search_view({scoring(three_hills), 1.0}, Goal::Best);
  // The two other three_hills shift the top of the first; at the top the score is at least that of
  // peak().
  EXPECT_GE(found.score, three_hills(peak()));
  EXPECT_LT(degrees_between(found.direction, peak()), 1.0);
}

TEST(GlobalSearch, ReachesAHundredthOfADegreeOfACusp) {
  const Vec3 top = Vec3(0.123, 0.456, -0.789).normalized();
  const auto cusp = [&](const Vec3& d) { return 2.0 - std::sqrt(degrees_between(d, top) / 180.0); };
  const FoundView found = search_view({scoring(cusp), 1.0}, Goal::Best);
  EXPECT_LT(degrees_between(found.direction, top), 0.01);
}

/// The middle of the triangle of the survey's directions whose middle is nearest to 6.5 degrees from z.
Vec3 place_between_directions() {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 4);
  Vec3 place = Vec3::UnitX();
  for (const Triangle& t : set.triangles) {
    const Vec3 middle =
        (set.directions[t[0]] + set.directions[t[1]] + set.directions[t[2]]).normalized();
    if (std::abs(degrees_between(middle, Vec3::UnitZ()) - 6.5) <
        std::abs(degrees_between(place, Vec3::UnitZ()) - 6.5)) {
      place = middle;
    }
  }
  return place;
}

TEST(GlobalSearch, FindsASpikeBesideTheLesserOfTwoHills) {
  const Vec3 spike = place_between_directions();
  const auto score = [&](const Vec3& d) {
    const auto terraces = [&](const Vec3& top, double tall, double steep) {
      const double angle = degrees_between(d, top) * std::numbers::pi / 180.0;
      return std::floor(20.0 * (tall - steep * angle)) / 20.0;
    };
    const double hills =
        std::max(terraces(Vec3::UnitX(), 1.0, 4.0), terraces(Vec3::UnitZ(), 0.94, 1.0));
    const double away = degrees_between(d, spike);
    return away < 1.5 ? std::max(hills, 1.1 - 0.01 * away) : hills;
  };
  const FoundView found =
      search_view({.score = scoring(score), .total = 1.0, .starts = 16}, Goal::Best);
  EXPECT_NEAR(found.score, 1.1, 1e-3);
}

TEST(GlobalSearch, EndsOnASmoothSummitWhereTheScoreGainsNoMore) {
  const Vec3 top = Vec3(0.123, 0.456, -0.789).normalized();
  const FoundView found =
      search_view({scoring([&](const Vec3& d) { return 1.0 + d.dot(top); }), 1.0}, Goal::Best);
  EXPECT_GT(found.score, 2.0 - 3e-4 * 2.0);
  EXPECT_LT(found.evaluations, 2562U + 150U);
}

TEST(GlobalSearch, FindsTheLowestOfSeveralPits) {
  const FoundView found =
      search_view({scoring([](const Vec3& d) { return 2.0 - three_hills(d); }), 1.0}, Goal::Worst);
  EXPECT_LE(found.score, 2.0 - three_hills(peak()));
}

TEST(GlobalSearch, OfABlankMapIsTheFirstDirection) {
  const FoundView found = search_view({scoring([](const Vec3&) { return 0.0; }), 0.0}, Goal::Worst);
  EXPECT_EQ(found.direction, direction_set(ViewSphereBase::Icosahedron, 3).directions[0]);
}

// A hill of 1.2° half width at half height, between the directions of level 3 (8° apart) but within
// reach of a direction of level 5 (2° apart), on a gentle slope that leads elsewhere.
double needle(const Vec3& d) {
  const Vec3 top = Vec3(0.31, 0.52, 0.79).normalized();
  return 0.1 * (1.0 - d.z()) + std::exp(3000.0 * (d.dot(top) - 1.0));
}

// The last ring has a radius of 4°/2^8 = 0.015625°. None of its six directions is better, so that
// the summit is at most 0.015625° / (2 cos 30°) = 0.00902° away; the slope, at most 0.1 per radian
// on a curvature of 3000, moves it by at most 0.1/3000 rad = 0.0019° from the needle's top.
TEST(DenseSearch, FindsANarrowPeakBetweenTheDirectionsOfACoarseSet) {
  const Vec3 top = Vec3(0.31, 0.52, 0.79).normalized();
  const FoundView found =
      search_view({scoring(needle), 1.0}, Goal::Best, {.strategy = SearchStrategy::Dense});
  EXPECT_LT(degrees_between(found.direction, top), 0.011);
}

TEST(DenseSearch, StartsFromTheDirectionsOfLevelFive) {
  const FoundView found =
      search_view({scoring(needle), 1.0}, Goal::Best, {.strategy = SearchStrategy::Dense});
  EXPECT_EQ(std::count_if(found.trace.begin(), found.trace.end(),
                          [](const SearchStep& step) { return step.level == 0; }),
            10242);
}

class SearchBy : public testing::TestWithParam<SearchStrategy> {};

TEST_P(SearchBy, ScoresNoDirectionTwice) {
  std::set<std::tuple<double, double, double>> asked;
  std::size_t count = 0;
  const auto counting = scoring([&](const Vec3& d) {
    ++count;
    asked.emplace(d.x(), d.y(), d.z());
    return three_hills(d);
  });
  const FoundViews found = search_best_and_worst({counting, 1.0}, {.strategy = GetParam()});
  EXPECT_EQ(asked.size(), count);
  EXPECT_EQ(found.best.evaluations + found.worst.evaluations, count);
}

TEST_P(SearchBy, FindsTheSameTogetherAsAlone) {
  const SearchOptions options{.strategy = GetParam()};
  const FoundViews both = search_best_and_worst({scoring(three_hills), 1.0}, options);
  EXPECT_EQ(both.best.direction,
            search_view({scoring(three_hills), 1.0}, Goal::Best, options).direction);
  EXPECT_EQ(both.worst.direction,
            search_view({scoring(three_hills), 1.0}, Goal::Worst, options).direction);
}

TEST_P(SearchBy, KeepsATraceOfWhatItScored) {
  const FoundView found =
      search_view({scoring(three_hills), 1.0}, Goal::Best, {.strategy = GetParam()});
  ASSERT_EQ(found.trace.size(), found.evaluations);
  for (const SearchStep& step : found.trace) {
    ASSERT_EQ(step.score, three_hills(step.direction));
    ASSERT_LE(step.score, found.score);
  }
}

TEST_P(SearchBy, ReportsFractionsThatNeverDecreaseAndEndAtOne) {
  double last = 0.0;
  const RunContext run{.report = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }};
  search_best_and_worst({scoring(three_hills), 1.0}, {.strategy = GetParam()}, run);
  EXPECT_EQ(last, 1.0);
}

TEST(GlobalSearch, ReportsFractionsThatNeverDecreaseWhereThereIsAProxy) {
  double last = 0.0;
  const RunContext run{.report = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }};
  ViewObjective objective{scoring(three_hills), 1.0};
  objective.proxy = objective.score;
  search_view(objective, Goal::Best, {}, run);
  EXPECT_EQ(last, 1.0);
}

TEST_P(SearchBy, StopsOnRequest) {
  std::stop_source source;
  const auto stopping = scoring([&](const Vec3& d) {
    source.request_stop();
    return three_hills(d);
  });
  EXPECT_THROW(search_view({stopping, 1.0}, Goal::Best, {.strategy = GetParam()},
                           {.stop = source.get_token()}),
               Cancelled);
}

INSTANTIATE_TEST_SUITE_P(Strategies, SearchBy,
                         testing::Values(SearchStrategy::Rapid, SearchStrategy::Exhaustive,
                                         SearchStrategy::Global, SearchStrategy::Dense,
                                         SearchStrategy::Gradient));

TEST_P(SearchBy, NeedsNoTotal) {
  const FoundView with =
      search_view({scoring(three_hills), 1.0}, Goal::Best, {.strategy = GetParam()});
  const FoundView without =
      search_view({scoring(three_hills)}, Goal::Best, {.strategy = GetParam()});
  EXPECT_LT(degrees_between(without.direction, with.direction), 0.1);
}

TEST_P(SearchBy, EndsWithTheBestOfItsStartSetWhereAllScoresAreSaidToBeEqual) {
  const FoundView found =
      search_view({scoring(three_hills), 0.0}, Goal::Best, {.strategy = GetParam()});
  EXPECT_EQ(found.trace.back().level, 0);
  for (const SearchStep& step : found.trace) {
    EXPECT_LE(step.score, found.score);
  }
}

TEST(RapidSearch, TakesEpsilonAsAFractionOfTheLargestInItsStartSetWithoutATotal) {
  SearchOptions options = paper();
  options.epsilon_is_fraction = true;
  // The largest of the corners is 1.5774, the first ring gains 0.4226.
  const auto last_level = [&](double epsilon) {
    options.epsilon = epsilon;
    return search_view({scoring(height)}, Goal::Best, options).trace.back().level;
  };
  EXPECT_EQ(last_level(0.4227 / 1.5773), 1);
  EXPECT_GT(last_level(0.4225 / 1.5774), 1);
}

TEST(RapidSearch, FollowsAPreferenceOnAScaleOfItsOwn) {
  const SearchOptions options{.strategy = SearchStrategy::Rapid};
  const FoundView plain = search_view({scoring(three_hills), 1.0}, Goal::Best, options);
  for (const double scale : {1e-6, 1e6}) {
    ViewObjective objective{scoring(three_hills), 1.0};
    objective.preference = [&](const Vec3& d, double) { return scale * three_hills(d); };
    const FoundView found = search_view(objective, Goal::Best, options);
    EXPECT_LT(degrees_between(found.direction, plain.direction), 0.1) << scale;
    EXPECT_LT(found.evaluations, 2 * plain.evaluations) << scale;
  }
}

TEST(SearchView, RefusesOptionsOutsideTheirRange) {
  EXPECT_THROW(search_view({scoring(three_hills), 1.0}, Goal::Best, {.subdivisions = 9}),
               InvalidInput);
  EXPECT_THROW(search_view({scoring(three_hills), 1.0}, Goal::Best, {.epsilon = -1.0}),
               InvalidInput);
  EXPECT_THROW(search_view({scoring(three_hills), -1.0}, Goal::Best), InvalidInput);
  EXPECT_THROW(search_view({.total = 1.0}, Goal::Best), InvalidInput);
  EXPECT_THROW(
      search_view({.score = scoring(three_hills), .total = 1.0, .survey_level = 7}, Goal::Best),
      InvalidInput);
  EXPECT_THROW(
      search_view({.score = scoring(three_hills), .total = 1.0, .finest_deg = 0.0}, Goal::Best),
      InvalidInput);
}

TEST_P(SearchBy, RefusesAScoreThatIsNotANumber) {
  const auto partly = scoring([](const Vec3& d) { return d.x() > 0.5 ? std::nan("") : d.y(); });
  EXPECT_THROW(search_view({partly, 1.0}, Goal::Best, {.strategy = GetParam()}), InvalidInput);
}

}  // namespace
}  // namespace vantage
