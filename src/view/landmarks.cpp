// SPDX-License-Identifier: MIT
#include "vantage/view/landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "vantage/mesh/measures.h"

#include "view/sphere_angles.h"

namespace vantage {
namespace {

// Normals are gathered in cells of a grid of this many to the unit length: about a degree wide, so
// that no cell of a round surface holds a noticeable share of it.
constexpr double kCells = 64.0;
constexpr double kLeastCellShare = 0.005;  // of the area; smaller cells are curved parts
constexpr double kSameFlatRad = 2.0 * kRadPerDeg;
constexpr double kLeastShare = 0.02;
constexpr std::size_t kMostFlats = 12;
constexpr double kSameRad = 0.1 * kRadPerDeg;
// Of brinks: how many of the largest flat parts are looked at, whose walls stand across them to
// this cosine; how far before and behind a wall's plane, as a sine (0.6°); and how far aside of
// the front's normal it may lie, as a sine.
constexpr std::size_t kMostFronts = 3;
constexpr double kAcross = 0.2;
constexpr double kBrink = 0.01;
constexpr double kMostAside = 0.9;

/// Area vectors of the faces whose normals fall in one cell; largest areas first.
std::vector<Vec3> area_vectors_by_normal(const TriMesh& surface, double area) {
  constexpr auto kSide = static_cast<std::uint32_t>(2.0 * kCells) + 1;
  std::unordered_map<std::uint32_t, Vec3> sum_of_cell;
  for (const Triangle& t : surface.triangles) {
    const Vec3 vector = area_vector(surface, t);
    const double size = vector.norm();
    if (size > 0.0) {
      // Of the least of faces the length is rounded so much that components exceed 1.
      const Vec3 at = (vector / size * kCells).array().round().max(-kCells).min(kCells) + kCells;
      const std::uint32_t cell =
          (static_cast<std::uint32_t>(at.x()) * kSide + static_cast<std::uint32_t>(at.y())) *
              kSide +
          static_cast<std::uint32_t>(at.z());
      sum_of_cell.try_emplace(cell, Vec3::Zero()).first->second += vector;
    }
  }
  std::vector<std::pair<std::uint32_t, Vec3>> large;
  for (const auto& [cell, sum] : sum_of_cell) {
    if (sum.norm() >= kLeastCellShare * area) {
      large.emplace_back(cell, sum);
    }
  }
  // The map's own order is not the surface's.
  std::sort(large.begin(), large.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vec3> vectors;
  vectors.reserve(large.size());
  for (const auto& [cell, sum] : large) {
    vectors.push_back(sum);
  }
  std::stable_sort(vectors.begin(), vectors.end(),
                   [](const Vec3& a, const Vec3& b) { return a.squaredNorm() > b.squaredNorm(); });
  return vectors;
}

/// Normals of the largest flat parts, largest first.
std::vector<Vec3> flat_normals(const TriMesh& surface, double area) {
  std::vector<Vec3> flats;
  for (const Vec3& vector : area_vectors_by_normal(surface, area)) {
    const auto same = std::find_if(flats.begin(), flats.end(), [&](const Vec3& flat) {
      return angle_between(flat, vector) < kSameFlatRad;
    });
    if (same == flats.end()) {
      flats.push_back(vector);
    } else {
      *same += vector;
    }
  }
  std::erase_if(flats, [&](const Vec3& flat) { return flat.norm() < kLeastShare * area; });
  flats.resize(std::min(flats.size(), kMostFlats));
  return flats;
}

// Moments closer than this, of the largest, make any direction between their axes as good as any
// other: rounding would choose.
constexpr double kLeastMomentGap = 1e-9;

/// The axes along which the surface's area is spread most and least and the third, as far as the
/// shape has them: none of a cube, one of a ring.
std::vector<Vec3> principal_axes(const TriMesh& surface, const std::vector<double>& areas) {
  Vec3 centre = Vec3::Zero();
  double area = 0.0;
  const auto middle = [&](const Triangle& t) -> Vec3 {
    return (surface.positions[t[0]] + surface.positions[t[1]] + surface.positions[t[2]]) / 3.0;
  };
  for (std::size_t f = 0; f < areas.size(); ++f) {
    centre += areas[f] * middle(surface.triangles[f]);
    area += areas[f];
  }
  centre /= area;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const Vec3 arm = middle(surface.triangles[f]) - centre;
    spread += areas[f] / area * arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Vec3& moments = solver.eigenvalues();  // in increasing order
  const double gap = kLeastMomentGap * moments[2];
  std::vector<Vec3> axes;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const bool shared = (axis > 0 && moments[axis] - moments[axis - 1] <= gap) ||
                        (axis < 2 && moments[axis + 1] - moments[axis] <= gap);
    if (!shared) {
      axes.emplace_back(solver.eigenvectors().col(axis));
    }
  }
  return axes;
}

/// How far the faces of about one normal lie along it at most.
double farthest_along(const TriMesh& surface, const Vec3& normal) {
  double farthest = -std::numeric_limits<double>::infinity();
  const double least = std::cos(kSameFlatRad);
  for (const Triangle& t : surface.triangles) {
    const Vec3 vector = area_vector(surface, t);
    if (vector.dot(normal) > least * vector.norm()) {
      for (const std::uint32_t v : t) {
        farthest = std::max(farthest, surface.positions[v].dot(normal));
      }
    }
  }
  return farthest;
}

}  // namespace

std::vector<FlatPart> flat_parts(const TriMesh& surface) {
  const double area = surface_area(surface);
  if (!(area > 0.0) || !std::isfinite(area)) {
    return {};
  }
  std::vector<FlatPart> parts;
  for (const Vec3& flat : flat_normals(surface, area)) {
    const Vec3 normal = flat.normalized();
    parts.push_back({normal, farthest_along(surface, normal)});
  }
  return parts;
}

std::vector<Vec3> brink_directions(std::span<const FlatPart> walls, const ScoringCamera& camera) {
  std::vector<Vec3> fronts;
  for (const auto& [wall, height] : walls) {
    const bool known =
        std::any_of(fronts.begin(), fronts.end(), [&, wall = wall](const Vec3& front) {
          return std::abs(front.dot(wall)) > std::cos(kSameFlatRad);
        });
    if (!known && fronts.size() < 2 * kMostFronts) {
      fronts.push_back(wall);
      fronts.emplace_back(-wall);
    }
  }
  std::vector<Vec3> directions;
  for (const auto& [wall, height] : walls) {
    // In perspective the eye passes the wall's plane aside of the front's normal.
    const double aside = camera.projection == Projection::Perspective
                             ? (height - wall.dot(camera.sphere.centre)) / camera.distance()
                             : 0.0;
    for (const Vec3& front : fronts) {
      if (std::abs(front.dot(wall)) > kAcross || !(std::abs(aside) < kMostAside)) {
        continue;
      }
      const Vec3 along = (front - front.dot(wall) * wall).normalized();
      for (const double by : {aside + kBrink, aside - kBrink}) {
        directions.push_back((by * wall + std::sqrt(1.0 - by * by) * along).normalized());
      }
    }
  }
  return directions;
}

std::vector<Vec3> landmark_directions(const TriMesh& surface, std::span<const FlatPart> walls) {
  const std::vector<double> areas = face_areas(surface);
  double area = 0.0;
  for (const double a : areas) {
    area += a;
  }
  if (!(area > 0.0) || !std::isfinite(area)) {
    return {};
  }
  std::vector<Vec3> lines;
  lines.reserve(6 + kMostFlats);
  for (int axis = 0; axis < 3; ++axis) {
    lines.emplace_back(Vec3::Unit(axis));
  }
  for (const Vec3& axis : principal_axes(surface, areas)) {
    lines.push_back(axis);
  }
  for (const FlatPart& wall : walls) {
    lines.push_back(wall.normal);
  }
  std::vector<Vec3> directions;
  for (const Vec3& line : lines) {
    for (const Vec3& direction : {line, Vec3(-line)}) {
      const bool known = std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) {
        return angle_between(d, direction) < kSameRad;
      });
      if (!known) {
        directions.push_back(direction);
      }
    }
  }
  return directions;
}

}  // namespace vantage
