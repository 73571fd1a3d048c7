// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "core/random.h"
#include "support/worst.h"

namespace vantage {
namespace {

/// Centre at equal distance from all of 2–4 points, in the flat they span; NaN if dependent.
Vec3 circumcentre(const std::vector<Vec3>& corners) {
  const auto k = static_cast<Eigen::Index>(corners.size()) - 1;
  Eigen::MatrixXd M(3, k);
  Eigen::VectorXd half(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    M.col(i) = corners[static_cast<std::size_t>(i) + 1] - corners[0];
    half(i) = 0.5 * M.col(i).squaredNorm();
  }
  const Eigen::MatrixXd gram = M.transpose() * M;
  return corners[0] + M * gram.fullPivLu().solve(half);
}

/// Smallest ball by trying every set of two to four points as its support.
double brute_force_diameter(const std::vector<Vec3>& points) {
  constexpr double kSlack = 1e-9;
  double best = std::numeric_limits<double>::infinity();
  for (unsigned set = 0; set < 1U << points.size(); ++set) {
    std::vector<Vec3> support;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((set >> i & 1U) != 0) {
        support.push_back(points[i]);
      }
    }
    if (support.size() < 2 || support.size() > 4) {
      continue;
    }
    const Vec3 centre = circumcentre(support);
    double radius = (support[0] - centre).norm();
    bool holds = std::isfinite(radius);
    for (const Vec3& p : points) {
      holds = holds && (p - centre).norm() <= radius * (1.0 + kSlack);
    }
    if (holds) {
      best = std::min(best, 2.0 * radius);
    }
  }
  return best;
}

class EnclosingSphereOfSeed : public ::testing::TestWithParam<unsigned> {};

void expect_the_smallest(const std::vector<Vec3>& points) {
  const double expected = brute_force_diameter(points);
  EXPECT_NEAR(enclosing_sphere(points).diameter, expected, 1e-9 * expected);
}

double random_coordinate(Pcg32& random) {
  return 2.0 * random.uniform() - 1.0;
}

TEST_P(EnclosingSphereOfSeed, IsTheSmallestThatTriesOfAllSupportsFind) {
  Pcg32 random(GetParam());
  std::vector<Vec3> points;
  points.reserve(9);
  for (int i = 0; i < 9; ++i) {
    points.emplace_back(random_coordinate(random), random_coordinate(random),
                        random_coordinate(random));
  }
  expect_the_smallest(points);
}

TEST_P(EnclosingSphereOfSeed, HandlesLatticePointsWithTheirManyTies) {
  Pcg32 random(GetParam(), 1);
  std::vector<Vec3> points;
  points.reserve(9);
  for (int i = 0; i < 9; ++i) {
    points.emplace_back(random.below(3), random.below(3), random.below(3));
  }
  expect_the_smallest(points);
}

TEST_P(EnclosingSphereOfSeed, HandlesPointsInAPlane) {
  Pcg32 random(GetParam(), 2);
  const Vec3 u = Vec3(1, 2, -1).normalized();
  const Vec3 v = Vec3(3, -1, 1).normalized();
  std::vector<Vec3> points;
  points.reserve(9);
  for (int i = 0; i < 9; ++i) {
    points.emplace_back(random_coordinate(random) * u + random_coordinate(random) * v);
  }
  expect_the_smallest(points);
}

TEST_P(EnclosingSphereOfSeed, HoldsEveryPointOfALargeCosphericalCloudFarFromTheOrigin) {
  Pcg32 random(GetParam(), 3);
  std::vector<Vec3> points;
  points.reserve(5000);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p(random_coordinate(random), random_coordinate(random), random_coordinate(random));
    points.emplace_back(Vec3(1e3, 0, 0) + p.normalized());
  }
  const Sphere sphere = enclosing_sphere(points);
  EXPECT_NEAR(sphere.diameter, 2.0, 2e-9);
  double farthest = 0.0;
  for (const Vec3& p : points) {
    farthest = test::larger(farthest, (p - sphere.centre).norm());
  }
  EXPECT_LE(farthest, 0.5 * sphere.diameter * (1.0 + 1e-10));
}

INSTANTIATE_TEST_SUITE_P(Seeds, EnclosingSphereOfSeed, ::testing::Range(0U, 40U));

}  // namespace
}  // namespace vantage
