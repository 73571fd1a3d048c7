// SPDX-License-Identifier: MIT
#include "render/tubes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/worst.h"

namespace vantage {
namespace {

constexpr int kSizePx = 64;

/// Looks along −z at the square [−1, 1]².
PictureRays front_rays() {
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.eye = Vec3(0, 0, 3);
  camera.height = 2.0;
  return PictureRays(camera, UnitFrame{}, 2.0, kSizePx, kSizePx);
}

/// Distance of a point from a segment.
double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 span = b - a;
  const double t = std::clamp((p - a).dot(span) / span.squaredNorm(), 0.0, 1.0);
  return (p - a - t * span).norm();
}

TEST(Tubes, EveryHitLiesOnATubeOrAJoint) {
  const CurveGraph graph{{Vec3(-0.6, -0.3, 0.4), Vec3(0.1, 0.5, -0.2), Vec3(0.7, -0.4, 0.1)},
                         {{0, 1}, {1, 2}}};
  const double radius = 0.08;
  const PictureRays rays = front_rays();
  const Tubes tubes(graph, radius, rays, kSizePx, kSizePx);
  int hits = 0;
  double worst = 0.0;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const PictureRay ray = rays.ray(x + 0.5, y + 0.5);
      const TubeHit hit = tubes.closest_hit(ray, x, y);
      if (!std::isfinite(hit.t)) {
        continue;
      }
      ++hits;
      const Vec3 p = ray.origin + hit.t * ray.direction;
      const double to_axis = std::min(segment_distance(p, graph.nodes[0], graph.nodes[1]),
                                      segment_distance(p, graph.nodes[1], graph.nodes[2]));
      const double to_end = std::min((p - graph.nodes[0]).norm(), (p - graph.nodes[2]).norm());
      const double off =
          test::smaller(std::abs(to_axis - radius), std::abs(to_end - kJointThickness * radius));
      worst = test::larger(worst, test::larger(off, std::abs(hit.normal.norm() - 1.0)));
    }
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(hits, 100);
}

TEST(Tubes, TheTileListsMissNoTube) {
  // The silhouette of a straight tube seen from the side: every pixel centre within its radius.
  const CurveGraph graph{{Vec3(-0.9, -0.75, 0.0), Vec3(0.9, 0.8, 0.0)}, {{0, 1}}};
  const double radius = 0.05;
  const PictureRays rays = front_rays();
  const Tubes tubes(graph, radius, rays, kSizePx, kSizePx);
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const Vec3 p((x + 0.5) * 2.0 / kSizePx - 1.0, 1.0 - (y + 0.5) * 2.0 / kSizePx, 0.0);
      const double distance = segment_distance(p, graph.nodes[0], graph.nodes[1]);
      const bool near_end = std::min((p - graph.nodes[0]).norm(), (p - graph.nodes[1]).norm()) <
                            kJointThickness * radius;
      const bool hit = std::isfinite(tubes.closest_hit(rays.ray(x + 0.5, y + 0.5), x, y).t);
      EXPECT_EQ(hit, distance < radius || near_end) << x << " " << y;
    }
  }
}

TEST(Tubes, BallBoundsHoldEveryRayThatMeetsTheBall) {
  Camera camera;
  camera.eye = Vec3(0.2, 0.1, 3.0);
  camera.fov_y_deg = 60.0;
  const PictureRays rays(camera, UnitFrame{}, 2.0, 80, 50);
  Pcg32 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 centre(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0,
                      2.0 * random.uniform() - 1.0);
    const double radius = 0.02 + 0.3 * random.uniform();
    const PixelBox box = rays.ball_bounds(centre, radius);
    for (int y = 0; y < 50; ++y) {
      for (int x = 0; x < 80; ++x) {
        const PictureRay ray = rays.ray(x + 0.5, y + 0.5);
        const Vec3 offset = centre - ray.origin;
        const double miss = (offset - offset.dot(ray.direction) * ray.direction).norm();
        const bool inside = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
        EXPECT_TRUE(inside || miss > radius) << trial << ": " << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace vantage
