// SPDX-License-Identifier: MIT
#include "render/tubes.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

/// Looks along −z from inside or before the square [−1, 1]².
PictureRays rays_from(double depth) {
  Camera camera;
  camera.eye = Vec3(0.2, 0.1, depth);
  camera.target = camera.eye - Vec3::UnitZ();
  camera.fov_y_deg = 60.0;
  return PictureRays(camera, UnitFrame{}, 2.0, 80, 50);
}

Vec3 random_point(Pcg32& random) {
  const double x = 2.0 * random.uniform() - 1.0;
  const double y = 2.0 * random.uniform() - 1.0;
  return {x, y, 2.0 * random.uniform() - 1.0};
}

/// Distance of a point from what is before a ray's origin.
double ray_distance(const Vec3& p, const PictureRay& ray) {
  const Vec3 offset = p - ray.origin;
  return (offset - std::max(offset.dot(ray.direction), 0.0) * ray.direction).norm();
}

TEST(Tubes, BoundsHoldEveryRayThatMeetsTheBall) {
  Pcg32 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const PictureRays rays = rays_from(trial % 2 == 0 ? 3.0 : 0.0);
    const Vec3 centre = random_point(random);
    const double radius = 0.02 + 0.3 * random.uniform();
    const PixelBox box = rays.bounds(centre, centre, radius);
    for (int y = 0; y < 50; ++y) {
      for (int x = 0; x < 80; ++x) {
        const bool inside = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
        EXPECT_TRUE(inside || ray_distance(centre, rays.ray(x + 0.5, y + 0.5)) > radius)
            << trial << ": " << x << " " << y;
      }
    }
  }
}

TEST(Tubes, TheTileListsMissNoTubeThatPassesTheEye) {
  Pcg32 random(6);
  int met = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const PictureRays rays = rays_from(0.0);
    const CurveGraph graph{{random_point(random), random_point(random)}, {{0, 1}}};
    const double radius = 0.02 + 0.1 * random.uniform();
    const Tubes tubes(graph, radius, rays, 80, 50, 1.0);
    for (int y = 0; y < 50; y += 3) {
      for (int x = 0; x < 80; x += 3) {
        const PictureRay ray = rays.ray(x + 0.5, y + 0.5);
        double least = 1.0;
        for (int k = 0; k <= 20; ++k) {
          const Vec3 p = graph.nodes[0] + k / 20.0 * (graph.nodes[1] - graph.nodes[0]);
          least = std::min(least, ray_distance(p, ray));
        }
        met += least < radius ? 1 : 0;
        EXPECT_TRUE(tubes.may_show(x, y) || least > radius) << trial << ": " << x << " " << y;
      }
    }
  }
  EXPECT_GT(met, 100);
}

/// Asks all at once and one by one. \return how many rays met any.
int hits_alike(const CurveGraph& graph, const PictureRays& rays, int width, int height) {
  const Tubes all(graph, 0.02, rays, width, height);
  std::vector<Tubes> single;
  for (const auto& [a, b] : graph.edges) {
    single.push_back(
        Tubes({{graph.nodes[a], graph.nodes[b]}, {{0, 1}}}, 0.02, rays, width, height));
  }
  int hits = 0;
  for (int y = 0; y < height; y += 3) {
    for (int x = 0; x < width; x += 3) {
      const PictureRay ray = rays.ray(x + 0.5, y + 0.5);
      TubeHit nearest;
      for (const Tubes& one : single) {
        const TubeHit hit = one.closest_hit(ray, x, y);
        nearest = hit.t < nearest.t ? hit : nearest;
      }
      const TubeHit hit = all.closest_hit(ray, x, y);
      EXPECT_EQ(hit.t, nearest.t) << x << " " << y;
      EXPECT_EQ(hit.normal, nearest.normal) << x << " " << y;
      hits += std::isfinite(hit.t) ? 1 : 0;
    }
  }
  return hits;
}

TEST(Tubes, OfManyBehindOneAnotherTheNearestIsMetWhateverTheirOrder) {
  Pcg32 random(8);
  CurveGraph graph;
  for (std::uint32_t i = 0; i < 300; ++i) {
    graph.nodes.push_back(random_point(random));
    graph.nodes.push_back(graph.nodes.back() + 0.3 * random_point(random));
    graph.edges.push_back({2 * i, 2 * i + 1});
  }
  EXPECT_GT(hits_alike(graph, front_rays(), kSizePx, kSizePx), 100);
  EXPECT_GT(hits_alike(graph, rays_from(3.0), 80, 50), 50);
  EXPECT_GT(hits_alike(graph, rays_from(0.0), 80, 50), 100);
}

/// A model of many posts beside the eye took all posts for every pixel.
TEST(Tubes, AreListedOnlyNearWhereTheyShow) {
  const auto tiles_of = [](const Vec3& begin, const Vec3& end) {
    const Tubes tubes({{begin, end}, {{0, 1}}}, 0.002, rays_from(0.0), 80, 50);
    int tiles = 0;
    for (int y = 0; y < 50; y += Tubes::kTilePx) {
      for (int x = 0; x < 80; x += Tubes::kTilePx) {
        tiles += tubes.may_show(x, y) ? 1 : 0;
      }
    }
    return tiles;
  };
  EXPECT_EQ(tiles_of({0.7, -1.0, 0.0}, {0.7, 1.0, 0.0}), 0);  // across the eye's plane, beside it
  EXPECT_EQ(tiles_of({0.7, 0.1, 1.0}, {0.7, 0.1, -0.1}), 0);  // ends before it comes into view
  EXPECT_LE(tiles_of({0.4, 0.25, 1.0}, {0.4, 0.25, -1.0}),
            12);  // along the line of sight, 70 tiles
}

}  // namespace
}  // namespace vantage
