// SPDX-License-Identifier: MIT
#include "spatial/nearest_point.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

/// Points of a coarse raster, where many are as near to a place, some of them several times.
std::vector<Vec3> raster_points(std::size_t count) {
  std::mt19937 random(7);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random() % 4, random() % 4, random() % 4);
  }
  return points;
}

TEST(NearestPoint, IsTheFirstOfTheNearestOfFewAndOfManyPoints) {
  for (const std::size_t count : {1U, 2U, 32U, 33U, 500U}) {
    const std::vector<Vec3> points = raster_points(count);
    const NearestPoint nearest(points);
    for (const Vec3& raster : raster_points(200)) {
      for (const Vec3& place : {raster, Vec3(0.5 * raster), Vec3(1.1 * raster)}) {
        const auto first =
            std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
              return (a - place).squaredNorm() < (b - place).squaredNorm();
            });
        ASSERT_EQ(nearest.to(place), static_cast<std::size_t>(first - points.begin()));
      }
    }
  }
}

}  // namespace
}  // namespace vantage
