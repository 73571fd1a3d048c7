// SPDX-License-Identifier: MIT
#include "pipeline/land.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

// In the grids in use few places on land are nearer to the origin than this, in metres or feet.
constexpr double kFarAway = 1e4;
// A part modelled at its place in a machine may be some times its size away from the origin.
constexpr double kSizesAway = 10.0;
// No mountain is this part as high as the origin of its grid is away.
constexpr double kLow = 0.1;

// Sheets of fewer faces may as well be posters, sails and signs.
constexpr std::size_t kFewFaces = 500;
// Of the rectangle around it, that a height field covers: once, but for rounding and what a border lacks.
constexpr double kCovered = 0.95;
constexpr double kCoveredOnce = 1.001;
// How high it is, over the shorter side of its rectangle: slopes of canyons are drawn too steep.
constexpr double kHigh = 0.5;
// Variances of slopes: below the first it is flat; a curtain's along its folds are less than this share of those
// across.
constexpr double kFlat = 1e-6;
constexpr double kRuled = 0.05;

std::optional<UpAxis> up_of_map(const Box& box) {
  const Vec3 away = (0.5 * (box.low + box.high)).cwiseAbs();
  const double far = std::max(kFarAway, kSizesAway * box.size().norm());
  const auto is_height = [&](double height, double a, double b) {
    return std::min(a, b) >= far && height <= kLow * std::min(a, b);
  };
  if (is_height(away.z(), away.x(), away.y())) {
    return UpAxis::Z;
  }
  return is_height(away.y(), away.x(), away.z()) ? std::optional(UpAxis::Y) : std::nullopt;
}

/// Sums over faces, seen along an axis: how much of its plane they cover, and how they slope.
class Slopes {
 public:
  explicit Slopes(Eigen::Index up) : up_(up) {}

  /// \param normal as long as twice the face's area.
  void add(const Vec3& normal) {
    const double covered = normal[up_];
    net_ += 0.5 * covered;
    total_ += 0.5 * std::abs(covered);
    if (covered != 0.0) {
      const Eigen::Vector2d slope(normal[(up_ + 1) % 3] / covered, normal[(up_ + 2) % 3] / covered);
      sum_ += 0.5 * std::abs(covered) * slope;
      squares_ += 0.5 * std::abs(covered) * slope.cwiseAbs2();
    }
  }

  /// Whether the faces are wound alike and cover a rectangle of this area once.
  [[nodiscard]] bool cover(double rectangle) const {
    return std::abs(net_) >= kCovered * rectangle && total_ <= kCoveredOnce * rectangle;
  }

  /// Whether slopes vary along both axes.
  [[nodiscard]] bool are_of_hills() const {
    const Eigen::Vector2d variance = squares_ / total_ - (sum_ / total_).cwiseAbs2();
    return variance.maxCoeff() > kFlat && variance.minCoeff() >= kRuled * variance.maxCoeff();
  }

 private:
  Eigen::Index up_;
  double net_ = 0.0;
  double total_ = 0.0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares_ = Eigen::Vector2d::Zero();
};

bool is_height_field(const TriMesh& mesh, const Vec3& size, Eigen::Index up) {
  const double a = size[(up + 1) % 3];
  const double b = size[(up + 2) % 3];
  if (mesh.triangles.size() < kFewFaces || size[up] > kHigh * std::min(a, b)) {
    return false;
  }
  Slopes slopes(up);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3& p = mesh.positions[i];
    slopes.add((mesh.positions[j] - p).cross(mesh.positions[k] - p));
  }
  return slopes.cover(a * b) && slopes.are_of_hills();
}

}  // namespace

std::optional<LandUp> up_of_land(const Model& model) {
  const bool is_stated =
      model.usual_up || model.format == ModelFormat::Gltf || model.format == ModelFormat::Glb;
  if (is_stated || model.mesh.positions.empty()) {
    return std::nullopt;
  }
  const Box box = bounding_box(referenced_points(model.mesh));
  if (const std::optional<UpAxis> up = up_of_map(box)) {
    return LandUp{*up, UpHabit::MapCoordinates};
  }
  const UpAxis up = box.size().z() < box.size().y() ? UpAxis::Z : UpAxis::Y;
  return is_height_field(model.mesh, box.size(), up == UpAxis::Z ? 2 : 1)
             ? std::optional(LandUp{up, UpHabit::HeightField})
             : std::nullopt;
}

}  // namespace vantage
