// SPDX-License-Identifier: MIT
#include "vantage/view/landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

/// Area vectors of the faces whose normals fall in one cell; largest areas first.
std::vector<Vec3> area_vectors_by_normal(const TriMesh& surface, double area) {
  std::map<std::array<int, 3>, Vec3> cells;
  for (const Triangle& t : surface.triangles) {
    const Vec3 vector = area_vector(surface, t);
    const double size = vector.norm();
    if (size > 0.0) {
      const Vec3 at = (vector / size * kCells).array().round();
      const std::array<int, 3> cell{static_cast<int>(at.x()), static_cast<int>(at.y()),
                                    static_cast<int>(at.z())};
      cells.try_emplace(cell, Vec3::Zero()).first->second += vector;
    }
  }
  std::vector<Vec3> vectors;
  for (const auto& [cell, vector] : cells) {
    if (vector.norm() >= kLeastCellShare * area) {
      vectors.push_back(vector);
    }
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

}  // namespace

std::vector<Vec3> landmark_directions(const TriMesh& surface) {
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
  for (const Vec3& normal : flat_normals(surface, area)) {
    lines.emplace_back(normal.normalized());
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
