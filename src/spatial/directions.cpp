// SPDX-License-Identifier: MIT
#include "vantage/spatial/directions.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <unordered_map>

#include <Eigen/Geometry>

#include "vantage/core/error.h"

#include "core/unit_direction.h"

namespace vantage {
namespace {

// Level 8 of the icosahedron has 655 362 directions.
constexpr int kMaxLevel = 8;

bool lexicographically_less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Adds the triangle so that it turns counter-clockwise seen from outside.
void add_outward(DirectionSet& set, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3& p = set.directions[a];
  const Vec3 normal = (set.directions[b] - p).cross(set.directions[c] - p);
  set.triangles.push_back(normal.dot(p) > 0.0 ? Triangle{a, b, c} : Triangle{a, c, b});
}

DirectionSet cube() {
  DirectionSet set;
  const double side = 1.0 / std::numbers::sqrt3;
  for (const double x : {-side, side}) {
    for (const double y : {-side, side}) {
      for (const double z : {-side, side}) {
        set.directions.emplace_back(x, y, z);
      }
    }
  }
  // Corner i has the bits (x, y, z) from high to low, so that index order is lexicographic order.
  for (const std::uint32_t axis : {4U, 2U, 1U}) {
    const std::uint32_t u = axis == 4 ? 2U : 4U;
    const std::uint32_t v = axis == 1 ? 2U : 1U;
    for (const std::uint32_t low : {0U, axis}) {
      add_outward(set, low, low + u, low + u + v);
      add_outward(set, low, low + u + v, low + v);
    }
  }
  return set;
}

DirectionSet icosahedron() {
  DirectionSet set;
  const double phi = std::numbers::phi;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-phi, phi}) {
      set.directions.emplace_back(0.0, a, b);
      set.directions.emplace_back(a, b, 0.0);
      set.directions.emplace_back(b, 0.0, a);
    }
  }
  std::sort(set.directions.begin(), set.directions.end(), lexicographically_less);
  // Edges have length 2, the next longer distance between corners is 2φ.
  constexpr double between = 2.5;
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return (set.directions[a] - set.directions[b]).norm() < between;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (joined(a, b) && joined(b, c) && joined(c, a)) {
          add_outward(set, a, b, c);
        }
      }
    }
  }
  for (Vec3& d : set.directions) {
    d.normalize();
  }
  return set;
}

/// Splits every triangle in four at the edge midpoints, projected to the sphere.
void split(DirectionSet& set) {
  std::unordered_map<std::uint64_t, std::uint32_t> middle_of_edge;  // looked up, never walked
  middle_of_edge.reserve(set.triangles.size() * 3 / 2);
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
    const auto [entry, fresh] =
        middle_of_edge.try_emplace(key, static_cast<std::uint32_t>(set.directions.size()));
    if (fresh) {
      const Vec3 sum = set.directions[a] + set.directions[b];
      set.directions.push_back(sum.normalized());
    }
    return entry->second;
  };
  std::vector<Triangle> finer;
  finer.reserve(4 * set.triangles.size());
  for (const auto& [a, b, c] : set.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  set.triangles = std::move(finer);
}

}  // namespace

DirectionSet direction_set(ViewSphereBase base, int level) {
  if (level < 0 || level > kMaxLevel) {
    throw InvalidInput("the level of a direction set is " + std::to_string(level) +
                       " but must be between 0 and " + std::to_string(kMaxLevel));
  }
  DirectionSet set = base == ViewSphereBase::Cube ? cube() : icosahedron();
  for (int i = 0; i < level; ++i) {
    split(set);
  }
  return set;
}

Vec3 loop_edge_direction(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 sum = 0.375 * (unit_direction(a) + unit_direction(b)) +
                   0.125 * (unit_direction(c) + unit_direction(d));
  return sum.normalized();
}

}  // namespace vantage
