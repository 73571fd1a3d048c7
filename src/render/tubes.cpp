// SPDX-License-Identifier: MIT
#include "render/tubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vantage {
namespace {

/// Below this squared sine a ray runs along a tube and can meet only its round ends.
constexpr double kParallel = 1e-12;

/// Box around two balls and, since pictures of segments are segments, all between them. A box that
/// is empty because it lies outside the picture still counts: it is clamped to the border.
PixelBox join(const PixelBox& a, const PixelBox& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace

Tubes::Tubes(const CurveGraph& graph, double radius, const PictureRays& rays, int width, int height,
             double joint_thickness) {
  std::vector<std::uint32_t> degree(graph.nodes.size(), 0);
  for (const auto& edge : graph.edges) {
    capsules_.push_back({graph.nodes[edge[0]], graph.nodes[edge[1]], radius});
    ++degree[edge[0]];
    ++degree[edge[1]];
  }
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    if (degree[n] != 2) {
      capsules_.push_back({graph.nodes[n], graph.nodes[n], joint_thickness * radius});
    }
  }
  tiles_across_ = (width + kTilePx - 1) / kTilePx;
  const int tiles_down = (height + kTilePx - 1) / kTilePx;
  std::vector<std::array<std::uint32_t, 2>> tile_and_capsule;
  for (std::uint32_t c = 0; c < capsules_.size(); ++c) {
    const double reach = capsules_[c].radius;
    if (rays.is_behind(capsules_[c].begin, reach) && rays.is_behind(capsules_[c].end, reach)) {
      continue;
    }
    const PixelBox box = join(rays.ball_bounds(capsules_[c].begin, capsules_[c].radius),
                              rays.ball_bounds(capsules_[c].end, capsules_[c].radius));
    for (int y = box.y0 / kTilePx; y * kTilePx < box.y1; ++y) {
      for (int x = box.x0 / kTilePx; x * kTilePx < box.x1; ++x) {
        tile_and_capsule.push_back({static_cast<std::uint32_t>(y * tiles_across_ + x), c});
      }
    }
  }
  std::sort(tile_and_capsule.begin(), tile_and_capsule.end());
  capsules_of_tile_.offsets.assign(static_cast<std::size_t>(tiles_across_ * tiles_down) + 1, 0);
  for (const auto& entry : tile_and_capsule) {
    ++capsules_of_tile_.offsets[entry[0] + 1];
    capsules_of_tile_.values.push_back(entry[1]);
  }
  for (std::size_t tile = 0; tile < capsules_of_tile_.size(); ++tile) {
    capsules_of_tile_.offsets[tile + 1] += capsules_of_tile_.offsets[tile];
  }
}

void Tubes::meet_ball(const Vec3& centre, double radius, const PictureRay& ray, TubeHit& hit) {
  const Vec3 from_centre = ray.origin - centre;
  const double middle = -from_centre.dot(ray.direction);
  const Vec3 nearest = from_centre + middle * ray.direction;
  const double inside = radius * radius - nearest.squaredNorm();
  if (inside < 0.0) {
    return;
  }
  const double t = middle - std::sqrt(inside);
  if (t >= 0.0 && t < hit.t) {
    hit.t = t;
    hit.normal = (from_centre + t * ray.direction) / radius;
  }
}

TubeHit Tubes::meet(const Capsule& capsule, const PictureRay& ray) {
  TubeHit hit;
  const Vec3 span = capsule.end - capsule.begin;
  // All of it lies within (|span| / 2 + radius)² ≤ 2 (|span|² / 4 + radius²) of its middle.
  const Vec3 from_middle = ray.origin - capsule.begin - 0.5 * span;
  const double nearest_squared =
      (from_middle - from_middle.dot(ray.direction) * ray.direction).squaredNorm();
  constexpr double kRounding = 1.0 + 1e-6;
  if (nearest_squared >
      kRounding * (0.5 * span.squaredNorm() + 2.0 * capsule.radius * capsule.radius)) {
    return hit;
  }
  meet_ball(capsule.begin, capsule.radius, ray, hit);
  const double length = span.norm();
  if (!(length > 0.0)) {
    return hit;
  }
  meet_ball(capsule.end, capsule.radius, ray, hit);
  // Across the axis the side of the tube is a circle.
  const Vec3 axis = span / length;
  const Vec3 from_begin = ray.origin - capsule.begin;
  const Vec3 across_direction = ray.direction - ray.direction.dot(axis) * axis;
  const Vec3 across_origin = from_begin - from_begin.dot(axis) * axis;
  const double a = across_direction.squaredNorm();
  if (a < kParallel) {
    return hit;
  }
  const double middle = -across_origin.dot(across_direction) / a;
  const double nearest = (across_origin + middle * across_direction).squaredNorm();
  const double inside = capsule.radius * capsule.radius - nearest;
  if (inside < 0.0) {
    return hit;
  }
  const double t = middle - std::sqrt(inside / a);
  const double place = (from_begin + t * ray.direction).dot(axis);
  if (t >= 0.0 && t < hit.t && place >= 0.0 && place <= length) {
    hit.t = t;
    hit.normal = (across_origin + t * across_direction) / capsule.radius;
  }
  return hit;
}

std::span<const std::uint32_t> Tubes::near(int x, int y) const {
  const auto row = static_cast<std::size_t>(y / kTilePx);
  const auto column = static_cast<std::size_t>(x / kTilePx);
  return capsules_of_tile_[row * static_cast<std::size_t>(tiles_across_) + column];
}

TubeHit Tubes::closest_hit(const PictureRay& ray, int x, int y) const {
  TubeHit nearest;
  for (const std::uint32_t c : near(x, y)) {
    const TubeHit hit = meet(capsules_[c], ray);
    if (hit.t < nearest.t) {
      nearest = hit;
    }
  }
  return nearest;
}

}  // namespace vantage
