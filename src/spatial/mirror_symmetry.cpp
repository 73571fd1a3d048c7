// SPDX-License-Identifier: MIT
#include "vantage/spatial/mirror_symmetry.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "core/unit_direction.h"
#include "spatial/point_cells.h"

namespace vantage {
namespace {

constexpr double kSamePlaneRad = 5.0 * std::numbers::pi / 180.0;
// As many as four reflections can make; the products of planes that are not exactly symmetric
// directions could otherwise grow without end.
constexpr std::size_t kMostImages = 16;
// Side of the samples over the surface's reach, finer than the tolerance; coarser where many
// layers would need more than about kSamples of them.
constexpr double kSpacing = 0.03;
constexpr double kSamples = 20000.0;
// Of faces within the spacing, and of longer ones, some are sampled where there are more, about so many;
// each then stands for as many as there are for one.
constexpr std::size_t kMostFaces = 50000;
// Samples whose mirror image is looked up: 2 % of the area are 80 of them.
constexpr std::size_t kQueries = 4000;

/// Points that stand for the surface, each with its share of the area.
struct SurfacePoints {
  std::vector<Vec3> points{};
  std::vector<double> shares{};
};

/// Bisects a triangle at its longest side until that is at most `spacing`; adds the centres.
/// \param weight of its area.
void add_samples(const std::array<Vec3, 3>& corners, double spacing, double weight,
                 SurfacePoints& set) {
  std::vector<std::array<Vec3, 3>> pending{corners};
  while (!pending.empty()) {
    const std::array<Vec3, 3> t = pending.back();
    pending.pop_back();
    const std::array<double, 3> sides{(t[1] - t[0]).norm(), (t[2] - t[1]).norm(),
                                      (t[0] - t[2]).norm()};
    const auto longest = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) -
                                                  sides.begin());  // the first of equal ones
    const Vec3& a = t[longest];
    const Vec3& b = t[(longest + 1) % 3];
    const Vec3& c = t[(longest + 2) % 3];
    if (sides[longest] > spacing) {
      const Vec3 middle = 0.5 * (a + b);
      pending.push_back({a, middle, c});
      pending.push_back({middle, b, c});
    } else {
      set.points.emplace_back((a + b + c) / 3.0);
      set.shares.push_back(weight * 0.5 * (b - a).cross(c - a).norm());
    }
  }
}

/// Area-weighted centroid of the faces, and the longest distance of a corner from it.
Sphere centroid_sphere(const TriMesh& surface, const std::vector<double>& areas, double total) {
  Sphere sphere;
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const auto& [a, b, c] = surface.triangles[f];
    sphere.centre += areas[f] / total / 3.0 *
                     (surface.positions[a] + surface.positions[b] + surface.positions[c]);
  }
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t v : t) {
      sphere.diameter =
          std::max(sphere.diameter, 2.0 * (surface.positions[v] - sphere.centre).norm());
    }
  }
  return sphere;
}

/// A number drawn for a face: by its corners, so that it does not depend on the order of faces.
std::uint64_t lot_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto mixed = [](std::uint64_t x) {  // as of SplitMix64 (Steele, Lea and Flood 2014)
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111eb;
    return x ^ (x >> 31U);
  };
  std::uint64_t lot = 0;
  for (const Vec3* const corner : {&a, &b, &c}) {
    std::uint64_t of_corner = 0;
    for (const double x : *corner) {
      of_corner = mixed(of_corner + 0x9e3779b97f4a7c15 + std::bit_cast<std::uint64_t>(x));
    }
    lot += of_corner;
  }
  return mixed(lot);
}

/// Samples of the surface relative to the centroid, over the longest distance from it (`reach`).
/// \param spacing receives the largest side of what a sample stands for, over reach.
SurfacePoints normalised_points(const TriMesh& surface, Vec3& centroid, double& spacing) {
  SurfacePoints set;
  const std::vector<double> areas = face_areas(surface);
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(total > 0.0)) {
    return set;
  }
  const Sphere around = centroid_sphere(surface, areas, total);
  const double reach = 0.5 * around.diameter;
  centroid = around.centre;
  spacing = std::max(kSpacing, std::sqrt(total / (reach * reach) / kSamples));
  const auto corners_of = [&](const Triangle& t) {
    return std::array<Vec3, 3>{(surface.positions[t[0]] - centroid) / reach,
                               (surface.positions[t[1]] - centroid) / reach,
                               (surface.positions[t[2]] - centroid) / reach};
  };
  const auto is_long = [&](const std::array<Vec3, 3>& t) {
    return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()}) > spacing;
  };
  const auto long_faces = static_cast<std::size_t>(
      std::count_if(surface.triangles.begin(), surface.triangles.end(),
                    [&](const Triangle& t) { return is_long(corners_of(t)); }));
  const std::size_t one_of_long = 1 + long_faces / kMostFaces;
  const std::size_t one_of_short = 1 + (surface.triangles.size() - long_faces) / kMostFaces;
  for (const Triangle& t : surface.triangles) {
    const std::array<Vec3, 3> corners = corners_of(t);
    const std::size_t one_of = is_long(corners) ? one_of_long : one_of_short;
    if (lot_of(surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]) %
            one_of ==
        0) {
      add_samples(corners, spacing, static_cast<double>(one_of), set);
    }
  }
  const double sampled = std::accumulate(set.shares.begin(), set.shares.end(), 0.0);
  for (double& share : set.shares) {
    share /= sampled;
  }
  return set;
}

/// Whether the mirror images of all but `outlier_share` of the area are as near to the surface as
/// the tolerance asks.
bool is_symmetric(const SurfacePoints& set, const PointCells& cells, const Vec3& normal,
                  const MirrorOptions& options) {
  const std::size_t stride = 1 + set.points.size() / kQueries;
  double all = 0.0;
  for (std::size_t i = 0; i < set.points.size(); i += stride) {
    all += set.shares[i];
  }
  double beyond = 0.0;
  for (std::size_t i = 0; i < set.points.size() && beyond <= options.outlier_share * all;
       i += stride) {
    const Vec3 image = set.points[i] - 2.0 * normal.dot(set.points[i]) * normal;
    beyond += cells.has_near(image) ? 0.0 : set.shares[i];
  }
  return all > 0.0 && beyond <= options.outlier_share * all;
}

std::vector<Vec3> candidate_normals(const SurfacePoints& set) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    spread += set.shares[i] * set.points[i] * set.points[i].transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::vector<Vec3> normals;
  for (Eigen::Index i = 0; i < 3; ++i) {
    Vec3 axis = axes.eigenvectors().col(i);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    normals.emplace_back(axis[largest] < 0.0 ? Vec3(-axis) : axis);
  }
  for (int i = 0; i < 3; ++i) {
    normals.emplace_back(Vec3::Unit(i));
  }
  return normals;
}

}  // namespace

std::vector<MirrorPlane> mirror_planes(const TriMesh& surface, const MirrorOptions& options) {
  Vec3 centroid = Vec3::Zero();
  double spacing = kSpacing;
  const SurfacePoints set = normalised_points(surface, centroid, spacing);
  std::vector<MirrorPlane> planes;
  if (set.points.empty()) {
    return planes;
  }
  // Reach is half an extent, the tolerance is of the whole one; samples of the two halves may lie
  // where they like within their spacing.
  const PointCells cells(set.points, 2.0 * options.tolerance + 0.6 * spacing);
  const double same = std::cos(kSamePlaneRad);
  for (const Vec3& normal : candidate_normals(set)) {
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const MirrorPlane& plane) {
      return std::abs(plane.normal.dot(normal)) > same;
    });
    if (!known && is_symmetric(set, cells, normal, options)) {
      planes.push_back({normal, centroid});
    }
  }
  return planes;
}

std::vector<Vec3> mirror_images(const Vec3& direction, std::span<const MirrorPlane> planes,
                                double apart_rad) {
  const double near = std::cos(apart_rad);
  std::vector<Vec3> images{unit_direction(direction)};
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const MirrorPlane& plane : planes) {
      const Vec3 image = images[i] - 2.0 * plane.normal.dot(images[i]) * plane.normal;
      const bool known = std::any_of(images.begin(), images.end(),
                                     [&](const Vec3& other) { return other.dot(image) > near; });
      if (!known && images.size() < kMostImages) {
        images.emplace_back(image.normalized());
      }
    }
  }
  return images;
}

}  // namespace vantage
