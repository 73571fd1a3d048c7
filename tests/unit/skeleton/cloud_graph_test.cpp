// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

#include "core/random.h"
#include "skeleton/point_skeleton.h"
#include "spatial/point_rings.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

constexpr double kRadius = 0.2;

/// The points of a shape, each moved by up to `reach` along every axis.
std::vector<Vec3> shaken(std::vector<Vec3> points, double reach) {
  Pcg32 random(7);
  for (Vec3& p : points) {
    for (double& x : p) {
      x += reach * (2.0 * random.uniform() - 1.0);
    }
  }
  return points;
}

Skeleton skeleton_of(const std::vector<Vec3>& points) {
  const PointContraction cloud = contract_points(points, find_outliers(points));
  return extract_point_skeleton(cloud.samples, cloud.sample_history);
}

std::size_t ends_of(const CurveGraph& graph) {
  std::vector<int> degree(graph.nodes.size(), 0);
  for (const auto& [a, b] : graph.edges) {
    ++degree[a];
    ++degree[b];
  }
  return static_cast<std::size_t>(std::count(degree.begin(), degree.end(), 1));
}

TEST(CloudSkeleton, OfAnEvenlySampledYHasThreeEnds) {
  const std::vector<Vec3> all = y_of_tubes(kRadius, 40).positions;  // some lie almost on each other
  std::vector<Vec3> even;
  for (const std::uint32_t i : spread_sample(all, all.size() / 2)) {
    even.push_back(all[i]);
  }
  EXPECT_EQ(ends_of(skeleton_of(even).graph), 3U);
}

TEST(CloudSkeleton, OfAYKeepsItsEndsUnderNoiseOfATwentiethOfTheRadius) {
  const Skeleton skeleton = skeleton_of(shaken(y_of_tubes(kRadius, 40).positions, 0.05 * kRadius));
  EXPECT_EQ(ends_of(skeleton.graph), 3U);
}

TEST(CloudSkeleton, OfAYHasNoLoopUnderNoiseOfATenthOfTheRadius) {
  const Skeleton skeleton = skeleton_of(shaken(y_of_tubes(kRadius, 40).positions, 0.1 * kRadius));
  EXPECT_GE(skeleton.graph.edges.size(), 3U);
  EXPECT_EQ(cycle_count(skeleton.graph), 0U);
}

TEST(CloudSkeleton, OfATorusIsNoShorterThanTwoThirdsOfItsAxis) {
  const CurveGraph graph = skeleton_of(torus(1.0, 0.3, 60, 20).positions).graph;
  EXPECT_EQ(cycle_count(graph), 1U);
  double length = 0.0;
  for (const auto& [a, b] : graph.edges) {
    length += (graph.nodes[a] - graph.nodes[b]).norm();
  }
  EXPECT_GT(length,
            2.0 / 3.0 * 2.0 * 3.14159);  // a polygon inscribed, drawn inwards by contraction
}

}  // namespace
}  // namespace vantage::test
