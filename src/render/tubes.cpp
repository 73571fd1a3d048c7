// SPDX-License-Identifier: MIT
#include "render/tubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace vantage {
namespace {

/// Below this squared sine a ray runs along a tube and can meet only its round ends.
constexpr double kParallel = 1e-12;

/// Pieces of a tube are halved until each lies in so many tiles each way. [ours]
constexpr int kTilesOfPiece = 2;

/// A hit's depth may be less than that of what is met by this, in the unit frame: rounding where a ray
/// touches a tube.
constexpr double kDepthSlack = 1e-6;

}  // namespace

Tubes::Tubes(const CurveGraph& graph, double radius, const PictureRays& rays, int width, int height,
             double joint_thickness)
    : sight_(-rays.back()) {
  std::vector<std::uint32_t> degree(graph.nodes.size(), 0);
  for (const auto& edge : graph.edges) {
    add(graph.nodes[edge[0]], graph.nodes[edge[1]], radius);
    ++degree[edge[0]];
    ++degree[edge[1]];
  }
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    if (degree[n] != 2) {
      add(graph.nodes[n], graph.nodes[n], joint_thickness * radius);
    }
  }
  std::sort(capsules_.begin(), capsules_.end(), [](const Capsule& a, const Capsule& b) {
    return std::tie(a.depth, a.index) < std::tie(b.depth, b.index);
  });
  tiles_across_ = (width + kTilePx - 1) / kTilePx;
  const int tiles_down = (height + kTilePx - 1) / kTilePx;
  std::vector<std::array<std::uint32_t, 2>> tile_and_capsule;
  for (std::uint32_t c = 0; c < capsules_.size(); ++c) {
    for (const std::uint32_t tile : tiles_of(capsules_[c], rays)) {
      tile_and_capsule.push_back({tile, c});
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

void Tubes::add(const Vec3& begin, const Vec3& end, double radius) {
  const auto index = static_cast<std::uint32_t>(capsules_.size());
  const double depth = std::min(begin.dot(sight_), end.dot(sight_)) - radius;
  capsules_.push_back({begin, end, radius, index, depth - kDepthSlack * (1.0 + std::abs(depth))});
}

std::vector<std::uint32_t> Tubes::tiles_of(const Capsule& capsule, const PictureRays& rays) const {
  std::vector<std::uint32_t> tiles;
  std::vector<std::array<Vec3, 2>> pieces{{capsule.begin, capsule.end}};
  while (!pieces.empty()) {
    const auto [begin, end] = pieces.back();
    pieces.pop_back();
    const PixelBox box = rays.bounds(begin, end, capsule.radius);
    if (box.is_empty()) {
      continue;
    }
    // The box around all of a slanted tube, or of one that passes the eye, would be much of the picture.
    const int widest = std::max(box.x1 - box.x0, box.y1 - box.y0);
    if (widest > kTilesOfPiece * kTilePx && (end - begin).norm() > 2.0 * capsule.radius) {
      const Vec3 middle = 0.5 * (begin + end);
      pieces.push_back({begin, middle});
      pieces.push_back({middle, end});
      continue;
    }
    for (int y = box.y0 / kTilePx; y * kTilePx < box.y1; ++y) {
      for (int x = box.x0 / kTilePx; x * kTilePx < box.x1; ++x) {
        tiles.push_back(static_cast<std::uint32_t>(y * tiles_across_ + x));
      }
    }
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  return tiles;
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
  std::uint32_t index = 0;
  const double start = ray.origin.dot(sight_);
  const double slope = ray.direction.dot(sight_);  // above 0
  for (const std::uint32_t c : near(x, y)) {
    const Capsule& capsule = capsules_[c];
    if (capsule.depth > start + nearest.t * slope) {
      break;
    }
    const TubeHit hit = meet(capsule, ray);
    if (hit.t < nearest.t || (hit.t == nearest.t && capsule.index < index)) {
      nearest = hit;
      index = capsule.index;
    }
  }
  return nearest;
}

}  // namespace vantage
