// SPDX-License-Identifier: MIT
#include "view/stance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

using Vec2 = Eigen::Vector2d;

// What is lower than this share of the height touches the ground: soles and tyres are not planes.
constexpr double kGroundShare = 0.01;
// A base of this share of the outline is one that things are made to stand on … [ours]
constexpr double kWideBase = 0.3;
// … and of this share, one that they touch by chance. [ours]
constexpr double kNoBase = 0.1;
// cos of 5 degrees off: planes are found to within that.
const double kAlong = std::cos(5.0 * std::numbers::pi / 180.0);

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2 && points.size() > 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double area_of(const std::vector<Vec2>& hull) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    twice += turn(hull[0], hull[i], hull[i + 1]);
  }
  return 0.5 * twice;
}

bool holds(const std::vector<Vec2>& hull, const Vec2& point) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (turn(hull[i], hull[(i + 1) % hull.size()], point) <= 0.0) {
      return false;
    }
  }
  return hull.size() >= 3;
}

Vec3 area_centre(const TriMesh& surface) {
  const std::vector<double> areas = vertex_areas(surface);
  Vec3 centre = Vec3::Zero();
  double total = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    total += areas[v];
    centre += areas[v] * surface.positions[v];
  }
  return total > 0.0 ? Vec3(centre / total) : centre;
}

}  // namespace

Stance stance(const TriMesh& surface, const Vec3& up, std::span<const MirrorPlane> planes) {
  Stance result;
  for (const MirrorPlane& plane : planes) {
    const double along = std::abs(plane.normal.dot(up));
    result.mirror_plane_level = result.mirror_plane_level || along > kAlong;
    result.mirror_plane_upright =
        result.mirror_plane_upright || along < std::sqrt(1.0 - kAlong * kAlong);
  }
  const std::vector<Vec3> points = referenced_points(surface);
  if (points.empty()) {
    return result;
  }
  const Vec3 right = up.unitOrthogonal();
  const Vec3 ahead = up.cross(right);
  const auto flat = [&](const Vec3& p) { return Vec2(right.dot(p), ahead.dot(p)); };
  double low = up.dot(points.front());
  double high = low;
  for (const Vec3& p : points) {
    low = std::min(low, up.dot(p));
    high = std::max(high, up.dot(p));
  }
  std::vector<Vec2> outline;
  std::vector<Vec2> ground;
  for (const Vec3& p : points) {
    outline.push_back(flat(p));
    if (up.dot(p) <= low + kGroundShare * (high - low)) {
      ground.push_back(flat(p));
    }
  }
  const std::vector<Vec2> base = hull_of(std::move(ground));
  const double whole = area_of(hull_of(std::move(outline)));
  const Vec3 centre = area_centre(surface);
  result.base_share = whole > 0.0 ? std::min(1.0, area_of(base) / whole) : 0.0;
  result.stands = holds(base, flat(centre));
  result.centre_height = high > low ? (up.dot(centre) - low) / (high - low) : 0.5;
  return result;
}

bool stands_only_on(const Stance& other, const Stance& expected) {
  return other.stands && other.base_share >= kWideBase && !other.mirror_plane_level &&
         expected.base_share <= kNoBase;
}

}  // namespace vantage
