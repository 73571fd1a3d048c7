// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/view/search.h"

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
constexpr double kTotal = 10.0;
constexpr double kFoundRad = 0.2 * kRadPerDeg;

double bump(const Vec3& d, const Vec3& centre, double width) {
  const double angle = angle_between(d, centre) / width;
  return std::exp(-angle * angle);
}

/// Three maxima, the highest at kHigh, and a minimum at kLow.
double hills(const Vec3& d) {
  return 5.0 + 3.0 * bump(d, kHigh, 0.4) + 2.7 * bump(d, Vec3::UnitX(), 0.4) +
         2.5 * bump(d, -Vec3::UnitZ(), 0.3) - 3.0 * bump(d, kLow, 0.5);
}

/// A surrogate that is wrong by up to `error`, differently in each direction.
Field wrong_by(double error) {
  return [error](const Vec3& d) {
    return hills(d) + error * std::sin(91.0 * d.x() + 57.0 * d.y() + 71.0 * d.z());
  };
}

ViewObjective objective(Field surrogate) {
  return {.score = batch_of(hills), .total = kTotal, .surrogate = batch_of(std::move(surrogate))};
}

TEST(GlobalSearchBySurrogate, FindsBothEndsWhereTheSurrogateIsNearlyRight) {
  const FoundViews views = search_best_and_worst(objective(wrong_by(0.05)));
  EXPECT_LT(angle_between(views.best.direction, kHigh), kFoundRad);
  EXPECT_LT(angle_between(views.worst.direction, kLow), kFoundRad);
}

TEST(GlobalSearchBySurrogate, ScoresOnlyWhereTheSurrogateLeads) {
  std::size_t exact = 0;
  std::size_t estimated = 0;
  const FoundViews views =
      search_best_and_worst({.score = batch_of(hills, &exact),
                             .total = kTotal,
                             .surrogate = batch_of(wrong_by(0.05), &estimated)});
  EXPECT_EQ(views.best.evaluations + views.worst.evaluations, exact);
  EXPECT_EQ(views.best.estimates + views.worst.estimates, estimated);
  EXPECT_EQ(estimated, 2562U);  // icosahedron level 4, once for both ends
  EXPECT_LT(exact, 500U);
}

TEST(GlobalSearchBySurrogate, FindsAMaximumThatTheSurrogateRanksBelowMany) {
  // The surrogate ranks the highest maximum below seven others that are not there at all.
  const auto misled = [](const Vec3& d) {
    double value = hills(d) - 1.5 * bump(d, kHigh, 0.4);
    for (int k = 0; k < 7; ++k) {
      const Vec3 ghost(std::cos(0.9 * k), std::sin(0.9 * k), 0.6 - 0.2 * k);
      value += 3.0 * bump(d, ghost.normalized(), 0.15);
    }
    return value;
  };
  const FoundView best = search_view(objective(misled), Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

TEST(GlobalSearchBySurrogate, LearnsWhereTheSurrogateIsTooHigh) {
  // Over a third of the sphere the surrogate promises more than the highest maximum holds, by one
  // broad bump with ripples that are peaks each.
  const auto flattered = [](const Vec3& d) {
    return hills(d) + 6.0 * bump(d, -Vec3::UnitY(), 0.6) +
           0.3 * std::sin(31.0 * d.x()) * std::sin(31.0 * d.z());
  };
  const FoundView best = search_view(objective(flattered), Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

TEST(GlobalSearchBySurrogate, ScoresAlongTheAxesWhateverTheSurrogateSays) {
  const auto spiked = [](const Vec3& d) { return hills(d) + 9.0 * bump(d, -Vec3::UnitY(), 1e-3); };
  const FoundView best = search_view(
      {.score = batch_of(spiked), .total = kTotal, .surrogate = batch_of(hills)}, Goal::Best);
  EXPECT_EQ(best.direction, Vec3(-Vec3::UnitY()));
}

TEST(GlobalSearchBySurrogate, StandsInfinitelyBadViews) {
  const auto half = [](const Field& field) -> Field {
    return [field](const Vec3& d) { return d.z() < -0.2 ? -HUGE_VAL : field(d); };
  };
  const ViewObjective blind{
      .score = batch_of(half(hills)), .total = kTotal, .surrogate = batch_of(half(wrong_by(0.05)))};
  EXPECT_LT(angle_between(search_view(blind, Goal::Best).direction, kHigh), kFoundRad);
}

TEST(GlobalSearchBySurrogate, ReportsExactScoresAndNoDirectionTwice) {
  const FoundView best = search_view(objective(wrong_by(0.3)), Goal::Best);
  EXPECT_EQ(best.score, hills(best.direction));
  std::set<std::tuple<double, double, double>> seen;
  for (const SearchStep& step : best.trace) {
    EXPECT_EQ(step.score, hills(step.direction));
    EXPECT_LE(step.score, best.score);
    EXPECT_TRUE(seen.insert({step.direction.x(), step.direction.y(), step.direction.z()}).second);
  }
}

TEST(GlobalSearch, EndsWhereAllViewsAreAlike) {
  std::size_t asked = 0;
  const auto same = [](const Vec3& /*direction*/) { return 3.0; };
  const FoundViews views =
      search_best_and_worst({.score = batch_of(same, &asked), .total = 3.0, .survey_level = 5});
  EXPECT_EQ(views.best.score, 3.0);
  EXPECT_EQ(views.worst.score, 3.0);
  EXPECT_LT(asked, 15'000U);
}

TEST(GlobalSearchBySurrogate, IsNotAskedByOtherStrategies) {
  std::size_t estimated = 0;
  for (const SearchStrategy strategy : {SearchStrategy::Rapid, SearchStrategy::Exhaustive,
                                        SearchStrategy::Dense, SearchStrategy::Gradient}) {
    search_view(
        {.score = batch_of(hills), .total = kTotal, .surrogate = batch_of(hills, &estimated)},
        Goal::Best, {.strategy = strategy, .subdivisions = 1});
  }
  EXPECT_EQ(estimated, 0U);
}

/// With a proxy that is the score but for one more bump.
ViewObjective objective_with_proxy(double height, const Vec3& centre, std::size_t* exact) {
  const auto nearly = [=](const Vec3& d) { return hills(d) + height * bump(d, centre, 0.4); };
  return {.score = batch_of(hills, exact),
          .total = kTotal,
          .surrogate = batch_of(wrong_by(0.05)),
          .proxy = batch_of(nearly)};
}

TEST(GlobalSearchByProxy, ClimbsByTheProxyAndEndsByTheScore) {
  std::size_t exact = 0;
  const Vec3 beside = (kHigh + 0.05 * Vec3::UnitX()).normalized();  // moves the maximum by 0.7°
  const FoundViews views = search_best_and_worst(objective_with_proxy(1.0, beside, &exact));
  EXPECT_LT(angle_between(views.best.direction, kHigh), kFoundRad);
  EXPECT_LT(angle_between(views.worst.direction, kLow), kFoundRad);
  EXPECT_EQ(views.best.score, hills(views.best.direction));
  EXPECT_EQ(views.best.evaluations + views.worst.evaluations, exact);
  EXPECT_LT(exact, 120U);
}

TEST(GlobalSearchByProxy, ChoosesAmongItsEndsByTheScore) {
  std::size_t exact = 0;
  // By the proxy the second maximum is higher by 0.1.
  const FoundView best = search_view(objective_with_proxy(0.4, Vec3::UnitX(), &exact), Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
  EXPECT_GT(exact, 0U);
}

TEST(GlobalSearchByProxy, KeepsTheBestOfASurveyByScoresThatTheProxyMisses) {
  const auto without_the_highest = [](const Vec3& d) {
    return hills(d) - 3.0 * bump(d, kHigh, 0.4);
  };
  const FoundView best = search_view(
      {.score = batch_of(hills), .total = kTotal, .proxy = batch_of(without_the_highest)},
      Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

/// The middle of a triangle of the survey's directions that is 3.5° to 4.5° from `centre`.
Vec3 between_directions_near(const Vec3& centre) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 4);
  Vec3 place = centre;
  for (const auto& [a, b, c] : set.triangles) {
    const Vec3 middle = (set.directions[a] + set.directions[b] + set.directions[c]).normalized();
    const double away = angle_between(middle, centre);
    if (away > 3.5 * kRadPerDeg && away < 4.5 * kRadPerDeg) {
      place = middle;
    }
  }
  return place;
}

TEST(GlobalSearchByProxy, ScoresAreAscendedFromTwoMaximaNotTwiceFromOne) {
  // By the proxy a broad maximum with a narrow one beside it is the highest, and the other is 11° away
  // from where it is: there the score is below both of these, until it is ascended.
  const Vec3 narrow = between_directions_near(Vec3::UnitX());
  const Vec3 astray = (kHigh + std::tan(11.0 * kRadPerDeg) * kHigh.unitOrthogonal()).normalized();
  const auto score = [](const Vec3& d) {
    return 5.0 + std::max(2.7 * bump(d, Vec3::UnitX(), 1.0), 3.0 * bump(d, kHigh, 0.4));
  };
  const auto nearly = [&](const Vec3& d) {
    const double broad = std::min(bump(d, Vec3::UnitX(), 0.3), 0.98);  // flat: worth a look near it
    return 5.0 + std::max(3.0 * broad, 2.8 * bump(d, astray, 0.4)) +
           (angle_between(d, narrow) < 1.3 * kRadPerDeg ? 0.2 : 0.0);
  };
  ASSERT_LT(score(astray), score(narrow));
  const FoundView best = search_view({.score = batch_of(score),
                                      .total = kTotal,
                                      .surrogate = batch_of(nearly),
                                      .proxy = batch_of(nearly)},
                                     Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
}

TEST(GlobalSearch, SurveysByTheScoreWhereThereIsNoSurrogate) {
  const FoundView best = search_view({batch_of(hills), kTotal}, Goal::Best);
  EXPECT_LT(angle_between(best.direction, kHigh), kFoundRad);
  EXPECT_EQ(best.estimates, 0U);
  EXPECT_GT(best.evaluations, 2562U);
}

TEST(GlobalSearch, FindsANarrowSummitBesideABroadOne) {
  // In the middle of a triangle of the survey, beside a summit that is flat to 3° from its middle.
  const Vec3 summit = between_directions_near(kHigh);
  const auto both = [&](const Vec3& d) {
    return std::min(bump(d, kHigh, 0.4), 0.98) +
           (angle_between(d, summit) < 1.3 * kRadPerDeg ? 0.2 : 0.0);
  };
  ViewObjective objective{batch_of(both), kTotal};
  const FoundView best = search_view(objective, Goal::Best);
  EXPECT_LT(angle_between(best.direction, summit), 1.3 * kRadPerDeg);
  // It is not looked for where the score, or what is preferred, is said to be smooth.
  objective.has_smooth_score = true;
  const FoundView broad = search_view(objective, Goal::Best);
  EXPECT_LT(broad.score, best.score);
  EXPECT_LT(broad.evaluations, best.evaluations);
  objective.preference = [](const Vec3& /*direction*/, double score) { return score; };
  EXPECT_EQ(search_view(objective, Goal::Best).direction, best.direction);
  objective.has_smooth_preference = true;
  EXPECT_EQ(search_view(objective, Goal::Best).direction, broad.direction);
}

TEST(GlobalSearch, SurveysAndRefinesAsTheObjectiveAsks) {
  const ViewObjective coarse{
      .score = batch_of(hills), .total = kTotal, .survey_level = 2, .finest_deg = 4.0};
  const FoundView best = search_view(coarse, Goal::Best);
  EXPECT_LT(best.evaluations, 162U + 100U);
  EXPECT_LT(angle_between(best.direction, kHigh), 4.0 * kRadPerDeg);
}

TEST(GlobalSearch, MaximisesThePreferenceAndReportsTheScore) {
  // Preference doubles what is seen from +x, whose maximum is lower by itself.
  ViewObjective preferred{batch_of(hills), kTotal};
  preferred.preference = [](const Vec3& d, double score) {
    return d.x() > 0.9 ? 2.0 * score : score;
  };
  const FoundViews found = search_best_and_worst(preferred);
  const FoundViews pure = search_best_and_worst({batch_of(hills), kTotal});
  EXPECT_LT(angle_between(found.best.direction, Vec3::UnitX()), kFoundRad);
  EXPECT_EQ(found.best.score, hills(found.best.direction));
  EXPECT_EQ(found.best.preference, 2.0 * found.best.score);
  EXPECT_EQ(found.worst.direction, pure.worst.direction);
  EXPECT_EQ(found.worst.score, pure.worst.score);
  EXPECT_EQ(found.worst.preference, found.worst.score);
}

}  // namespace
}  // namespace vantage
