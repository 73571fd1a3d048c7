// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/view_set.h"

#include "core/random.h"
#include "support/worst.h"

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Vec3> random_directions(std::size_t count, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<Vec3> directions;
  while (directions.size() < count) {
    const Vec3 p(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0,
                 2.0 * random.uniform() - 1.0);
    if (p.norm() > 0.1 && p.norm() < 1.0) {
      directions.push_back(p.normalized());
    }
  }
  return directions;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double length_of(const std::vector<Vec3>& directions, const std::vector<std::size_t>& order) {
  double sum = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sum += angle(directions[order[i]], directions[order[(i + 1) % order.size()]]);
  }
  return sum;
}

TEST(ShortestTour, GoesRoundTheOctahedronInSixRightAngles) {
  const std::vector<Vec3> corners{Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                                  -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  const Tour tour = shortest_tour(corners);
  EXPECT_NEAR(tour.length_rad, 6.0 * kPi / 2.0, 1e-12);
  EXPECT_TRUE(tour.optimal);
}

TEST(ShortestTour, IsTheShortestOfAllRounds) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::vector<Vec3> directions = random_directions(7, seed);
    std::vector<std::size_t> order(7);
    std::iota(order.begin(), order.end(), 0);
    double shortest = length_of(directions, order);
    do {
      shortest = std::min(shortest, length_of(directions, order));
    } while (std::next_permutation(order.begin() + 1, order.end()));
    EXPECT_NEAR(shortest_tour(directions).length_rad, shortest, 1e-12) << seed;
  }
}

TEST(ShortestTour, VisitsEveryViewOnceFromTheFirst) {
  for (const std::size_t count : {1UL, 2UL, 3UL, 12UL, 13UL, 40UL}) {
    std::vector<std::size_t> order = shortest_tour(random_directions(count, 3)).order;
    EXPECT_EQ(order.front(), 0U);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(order.at(i), i);
    }
  }
}

TEST(ShortestTour, FindsTheCircleAmongManyViewsOnIt) {
  // 40 views on the equator in a shuffled order: the shortest round is the circle itself.
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < 40; ++i) {
    const double at = 2.0 * kPi * static_cast<double>(i * 17 % 40) / 40.0;
    directions.emplace_back(std::cos(at), std::sin(at), 0.0);
  }
  const Tour tour = shortest_tour(directions);
  EXPECT_NEAR(tour.length_rad, 2.0 * kPi, 1e-9);
  EXPECT_FALSE(tour.optimal);
}

TEST(ShortestTour, NoReversalShortensALongRound) {
  const std::vector<Vec3> directions = random_directions(30, 5);
  const Tour tour = shortest_tour(directions);
  for (std::size_t i = 1; i < 30; ++i) {
    for (std::size_t j = i + 1; j <= 30; ++j) {
      std::vector<std::size_t> other = tour.order;
      std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                   other.begin() + static_cast<std::ptrdiff_t>(j));
      EXPECT_GE(length_of(directions, other), tour.length_rad - 1e-9);
    }
  }
}

TEST(ShortestTour, RefusesNoViews) {
  EXPECT_THROW(shortest_tour({}), InvalidInput);
}

/// Four stops on the equator around y.
const std::vector<Vec3> kEquator{Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitZ(), -Vec3::UnitX()};
/// A round over both poles of y.
const std::vector<Vec3> kMeridian{Vec3::UnitZ(), Vec3::UnitY(), -Vec3::UnitZ(), -Vec3::UnitY()};

TEST(TourPath, TravelsAtAConstantSpeedOnTheSphere) {
  const std::vector<TourPose> poses = tour_path(random_directions(5, 1), Vec3::UnitY(), 720);
  double longest = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].direction.norm(), 1.0, 1e-12);
    const double step = angle(poses[i].direction, poses[(i + 1) % poses.size()].direction);
    longest = test::larger(longest, step);
    sum += step;
  }
  // A step across a stop cuts a corner, all others are equal: none is above the mean of the path.
  EXPECT_LE(longest, sum / 720.0 * 1.02);
}

TEST(TourPath, PassesEveryStop) {
  const std::vector<TourPose> poses = tour_path(kEquator, Vec3::UnitY(), 360);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((poses[90 * i].direction - kEquator[i]).norm(), 0.0, 1e-9);
  }
}

TEST(TourPath, StaysUprightOnTheEquator) {
  for (const TourPose& pose : tour_path(kEquator, Vec3::UnitY(), 100)) {
    EXPECT_NEAR((pose.up - Vec3::UnitY()).norm(), 0.0, 1e-9);
  }
}

TEST(TourPath, UpIsAUnitVectorAcrossTheLineOfSight) {
  for (const TourPose& pose : tour_path(random_directions(8, 2), Vec3::UnitZ(), 500)) {
    EXPECT_NEAR(pose.up.norm(), 1.0, 1e-12);
    EXPECT_NEAR(pose.up.dot(pose.direction), 0.0, 1e-9);
  }
}

TEST(TourPath, NeverRollsAtOnceEvenStraightOverThePoles) {
  const std::vector<TourPose> poses = tour_path(kMeridian, Vec3::UnitY(), 360);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    // One degree of way; half a turn at a pole is spread over tens of degrees.
    const TourPose& next = poses[(i + 1) % poses.size()];
    EXPECT_LT(angle(poses[i].up, next.up), 10.0 * kPi / 180.0) << i;
  }
}

TEST(TourPath, IsUprightAgainAwayFromThePoles) {
  const std::vector<TourPose> poses = tour_path(kMeridian, Vec3::UnitY(), 360);
  for (const std::size_t i : {0UL, 180UL}) {
    EXPECT_GT(poses[i].up.y(), std::cos(10.0 * kPi / 180.0)) << i;
  }
}

TEST(TourPath, JoinsOppositeStopsAlongTheEquator) {
  const std::vector<Vec3> stops{Vec3::UnitX(), -Vec3::UnitX()};
  for (const TourPose& pose : tour_path(stops, Vec3::UnitY(), 50)) {
    EXPECT_NEAR(pose.direction.y(), 0.0, 1e-9);
  }
}

TEST(TourPath, RefusesStopsThatAreAllTheSame) {
  const std::vector<Vec3> stops{Vec3::UnitX(), Vec3::UnitX()};
  EXPECT_THROW(tour_path(stops, Vec3::UnitY(), 50), InvalidInput);
  EXPECT_THROW(tour_path(std::span(stops).first(1), Vec3::UnitY(), 50), InvalidInput);
  EXPECT_THROW(tour_path(kEquator, Vec3::UnitY(), 2), InvalidInput);
}

}  // namespace
}  // namespace vantage
