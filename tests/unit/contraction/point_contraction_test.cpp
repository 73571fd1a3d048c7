// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "skeleton/point_skeleton.h"
#include "support/many_threads.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage::test {
namespace {

PointContraction contracted(const std::vector<Vec3>& points, int threads = 0) {
  return contract_points(points, find_outliers(points), {}, {.max_threads = threads});
}

TEST(PointContraction, BringsACylinderToItsAxis) {
  const std::vector<Vec3> points = open_cylinder(0.2, 2.0, 24, 60).positions;
  const PointContraction cloud = contracted(points);
  double farthest = 0.0;
  for (const Vec3& p : cloud.history.levels.back()) {
    farthest = larger(farthest, std::hypot(p.x(), p.y()));
  }
  EXPECT_LT(farthest, 0.1 * 0.2);
}

/// A number from −½ to ½ that looks like noise.
double noise(double i, double series) {
  const double large = 43758.5453 * std::abs(std::sin(12.9898 * i + series));
  return large - std::floor(large) - 0.5;
}

TEST(PointContraction, RunsNoNoisyLineToAPoint) {
  for (const int count : {24, 30, 40, 60, 80, 200}) {
    for (const double width : {1e-5, 1e-3, 0.01, 0.03}) {
      std::vector<Vec3> points;
      points.reserve(static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        points.emplace_back(10.0 * i / count, width * noise(i, 0.0), width * noise(i, 1.0));
      }
      const ContractionHistory history = contracted(points).history;
      for (std::size_t level = 1; level < history.levels.size(); ++level) {
        EXPECT_GT(bounding_box(history.levels[level]).size().x(),
                  0.69 * bounding_box(history.levels[level - 1]).size().x())
            << count << ' ' << width << ' ' << level;
      }
    }
  }
}

TEST(PointContraction, WantsOneEntryAPointOfWhatIsLeftOut) {
  const std::vector<Vec3> points = torus(1.0, 0.3, 10, 10).positions;
  EXPECT_THROW(contract_points(points, std::vector<std::uint8_t>(points.size() - 1, 0)),
               InvalidInput);
  EXPECT_THROW(contract_points(points, std::vector<std::uint8_t>(points.size() + 1, 0)),
               InvalidInput);
}

TEST(PointContraction, LeavesPointsWhereTheyAreIfAllAreLeftOut) {
  const std::vector<Vec3> points = torus(1.0, 0.3, 10, 10).positions;
  const PointContraction cloud =
      contract_points(points, std::vector<std::uint8_t>(points.size(), 1), {});
  ASSERT_EQ(cloud.history.levels.size(), 1U);
  EXPECT_EQ(cloud.history.levels[0], points);
  EXPECT_TRUE(cloud.samples.positions.empty());
}

TEST(PointContraction, SaysThatMethodsOfMeshesDoNotHold) {
  const std::vector<Vec3> points = torus(1.0, 0.3, 10, 10).positions;
  const std::vector<std::uint8_t> none(points.size(), 0);
  EXPECT_TRUE(contract_points(points, none, {}).history.warnings.empty());
  const ContractionHistory exact =
      contract_points(points, none, {.method = ContractionMethod::Exact}).history;
  ASSERT_EQ(exact.warnings.size(), 1U);
  EXPECT_NE(exact.warnings.front().find("for meshes"), std::string::npos);
}

TEST(PointContraction, KeepsTheOneLoopOfATorus) {
  const PointContraction cloud = contracted(torus(1.0, 0.3, 60, 20).positions);
  const Skeleton skeleton = extract_point_skeleton(cloud.samples, cloud.sample_history);
  EXPECT_EQ(component_count(skeleton.graph), 1U);
  EXPECT_EQ(cycle_count(skeleton.graph), 1U);
}

TEST(PointContraction, KeepsTwoSpheresApart) {
  const TriMesh one = sphere(3);
  const PointContraction cloud = contracted(together(one, one, Vec3(3.0, 0.0, 0.0)).positions);
  const Skeleton skeleton = extract_point_skeleton(cloud.samples, cloud.sample_history);
  EXPECT_EQ(cloud.history.components.size(), 2U);
  EXPECT_EQ(component_count(skeleton.graph), 2U);
  EXPECT_EQ(cycle_count(skeleton.graph), 0U);
}

TEST(PointContraction, GivesTheSameBytesForAnyThreadCount) {
  const std::vector<Vec3> points = y_of_tubes(0.2, 40).positions;
  const PointContraction three = with_many_threads([&] { return contracted(points, 3); });
  EXPECT_EQ(contracted(points, 1).history.levels, three.history.levels);
}

TEST(PointContraction, CommutesWithScaling) {
  const TriMesh shape = y_of_tubes(0.2, 30);
  const auto small = contracted(shape.positions).history;
  constexpr double kScale = 0x1p20;  // exact, so that only D's rounding differs
  const TriMesh big = moved(shape, kScale, 0.0, Vec3::UnitZ(), Vec3::Zero());
  const auto large = contracted(big.positions).history;
  ASSERT_EQ(small.levels.size(), large.levels.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < shape.positions.size(); ++i) {
    worst = larger(worst, (large.levels.back()[i] / kScale - small.levels.back()[i]).norm());
  }
  EXPECT_LT(worst, 1e-6);
}

/// Oracle: mean distance of a point to its 16 nearest neighbours, and those, by looking at all.
std::pair<double, std::vector<std::size_t>> surroundings(const std::vector<Vec3>& points,
                                                         std::size_t i) {
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (j != i) {
      others.emplace_back((points[j] - points[i]).norm(), j);
    }
  }
  std::partial_sort(others.begin(), others.begin() + 16, others.end());
  std::pair<double, std::vector<std::size_t>> result;
  for (std::size_t k = 0; k < 16; ++k) {
    result.first += others[k].first / 16.0;
    result.second.push_back(others[k].second);
  }
  return result;
}

TEST(FindOutliers, AreThreeTimesAsFarFromTheirSixteenNeighboursAsTheseAreFromTheirs) {
  std::vector<Vec3> points = sphere(3).positions;
  points.push_back(Vec3::Zero());
  int outliers = 0;
  constexpr int kHeights = 64;
  for (int k = 0; k < kHeights; ++k) {
    points.back() = (1.4 + 0.0125 * k) * Vec3(1.0, 2.0, 2.0) / 3.0;
    const auto [distance, near] = surroundings(points, points.size() - 1);
    std::vector<double> theirs{distance};  // 17 with its own: the ninth is the median
    for (const std::size_t j : near) {
      theirs.push_back(surroundings(points, j).first);
    }
    std::sort(theirs.begin(), theirs.end());
    const int expected = distance > 3.0 * theirs[8] ? 1 : 0;
    outliers += expected;
    EXPECT_EQ(find_outliers(points).back(), expected) << k;
  }
  EXPECT_GT(outliers, kHeights / 10);
  EXPECT_LT(outliers, kHeights - kHeights / 10);
}

TEST(FindOutliers, AreFoundAmongOutliers) {
  std::vector<Vec3> points = sphere(4).positions;
  const std::size_t surface = points.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  while (points.size() < surface + surface / 40) {
    const Vec3 p(place(random), place(random), place(random));
    if (std::abs(p.norm() - 1.0) > 0.5) {
      points.push_back(p);
    }
  }
  const std::vector<std::uint8_t> found = find_outliers(points);
  EXPECT_EQ(std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(surface), 1), 0);
  EXPECT_EQ(std::count(found.begin() + static_cast<std::ptrdiff_t>(surface), found.end(), 0), 0);
}

TEST(PointContraction, LeavesAFarPointOutAndInItsPlace) {
  std::vector<Vec3> points = sphere(3).positions;
  points.emplace_back(3.0, 0.0, 0.0);
  const PointContraction cloud = contracted(points);
  EXPECT_EQ(cloud.history.component_of_vertex.back(), ContractionHistory::kIsolated);
  EXPECT_EQ(cloud.history.levels.back().back(), points.back());
}

TEST(PointContraction, CarriesManyPointsToTheAxisOverSamples) {
  const std::vector<Vec3> points = open_cylinder(0.2, 2.0, 100, 250).positions;
  const PointContraction cloud = contracted(points);
  EXPECT_LT(cloud.samples.positions.size(), points.size());
  double farthest = 0.0;
  for (const Vec3& p : cloud.history.levels.back()) {
    farthest = larger(farthest, std::hypot(p.x(), p.y()));
  }
  EXPECT_LT(farthest, 0.1 * 0.2);
}

}  // namespace
}  // namespace vantage::test
