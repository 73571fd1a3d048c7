// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/measures.h"
#include "vantage/visibility/face_visibility.h"

#include "core/cross.h"
#include "spatial/face_clip.h"
#include "visibility/surface.h"

/// \file
/// Areas, areas in the picture and depths of what is seen, in closed form, face by face. Inline, as
/// every face seen of every view is added up.

namespace vantage {

/// For one view.
class FaceSums {
 public:
  /// \param local the eye in the surface's frame. \param sphere of the mesh. \param along is filled; all
  ///              must outlive this.
  FaceSums(const Surface& surface, const Sphere& sphere, const Viewpoint& local,
           std::vector<double>& along, SeenSurface& result)
      : surface_(surface),
        local_(local),
        is_perspective_(local.projection == Projection::Perspective),
        per_diameter_(1.0 / (sphere.diameter * surface.frame.scale)),
        to_model_(0.5 / (surface.frame.scale * surface.frame.scale)),
        along_(along),
        result_(result) {
    const Vec3 centre = surface.frame.to_frame(sphere.centre);
    const Vec3 to_eye = local.position - centre;
    const bool is_centre = !(to_eye.squaredNorm() > 0.0);
    towards_ = !is_perspective_ ? local.position : is_centre ? Vec3::UnitZ() : to_eye.normalized();
    plane_ = to_eye.dot(towards_);
    nearest_ = plane_ * per_diameter_ > 0.5 + kOutside ? 0.0 : kNearest / per_diameter_;
    along_.resize(surface.samples.size());
    for (std::size_t sample = 0; sample < along_.size(); ++sample) {
      along_[sample] = (surface.samples[sample] - centre).dot(towards_);
    }
  }

  /// Depth of a sample from the side of the sphere next to the eye, over its diameter.
  [[nodiscard]] double depth(std::uint32_t sample) const { return depth_at(along_[sample]); }

  /// Begins with a face of which something is seen.
  void begin(std::uint32_t face) {
    const Triangle& corners = surface_.faces[face];
    for (std::size_t k = 0; k < 3; ++k) {
      at_corner_[k] = along_[corners[k]];
    }
    const Vec3& normal = surface_.area_vectors[face];
    area_ = to_model_ * surface_.twice_areas[face];
    picture_ =
        to_model_ * (is_perspective_
                         ? plane_ * plane_ *
                               std::abs(normal.dot(surface_.samples[corners[0]] - local_.position))
                         : std::abs(normal.dot(towards_)));
    result_.faces.push_back({.face = surface_.face_of_mesh[face]});
  }

  /// Adds all of it.
  void add_whole() {
    const auto [low, high] = std::minmax({at_corner_[0], at_corner_[1], at_corner_[2]});
    const double first = std::floor(depth_at(high) * kBins);
    if (depth_at(low) * kBins > first + 1.0 || plane_ - high < nearest_) {
      add(kWholeFace);
      return;
    }
    SeenFace& seen = result_.faces.back();
    seen.visible_area = area_;
    seen.of_corners.fill(area_ / 3.0);
    seen.projected_area = is_perspective_
                              ? picture_ / ((plane_ - at_corner_[0]) * (plane_ - at_corner_[1]) *
                                            (plane_ - at_corner_[2]))
                              : picture_;
    result_.depths[bin(first)] += seen.projected_area;
    result_.deepest = std::max(result_.deepest, depth_at(low));
  }

  /// Adds a convex part of it.
  void add(Polygons::Points part) {
    SeenFace& seen = result_.faces.back();
    double low = kBins;
    double high = 0.0;
    for (const Eigen::Vector2d& corner : part) {
      const double depth = depth_at(along_at(corner));
      low = std::min(low, depth * kBins);
      high = std::max(high, depth * kBins);
      result_.deepest = std::max(result_.deepest, depth);
    }
    for (std::size_t k = 2; k < part.size(); ++k) {
      const double share = area_ / 3.0 * cross(part[k - 1] - part[0], part[k] - part[0]);
      const Eigen::Vector2d sum = part[0] + part[k - 1] + part[k];
      seen.visible_area += 3.0 * share;
      seen.of_corners[0] += share * sum.x();
      seen.of_corners[1] += share * sum.y();
      seen.of_corners[2] += share * (3.0 - sum.x() - sum.y());
    }
    const double projected = picture_area(part);
    seen.projected_area += projected;
    const double first = std::floor(low);
    if (high <= first + 1.0) {
      result_.depths[bin(first)] += projected;
    } else {
      spread(part, first, high, projected);
    }
  }

 private:
  static constexpr auto kBins = static_cast<double>(SeenSurface::kDepthBins);
  // Of the sphere's diameter: an eye less outside than this counts as inside, and then nothing
  // nearer than the other, along the line of sight, has a place in the picture. [ours]
  static constexpr double kOutside = 1e-6;
  static constexpr double kNearest = 1e-3;

  [[nodiscard]] double depth_at(double along) const {
    return std::clamp(0.5 - along * per_diameter_, 0.0, 1.0);
  }

  [[nodiscard]] double along_at(const Eigen::Vector2d& place) const {
    return place.x() * at_corner_[0] + place.y() * at_corner_[1] +
           (1.0 - place.x() - place.y()) * at_corner_[2];
  }

  static std::size_t bin(double at) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, kBins - 1.0));
  }

  /// How far a place is from the eye along the line of sight, at least `nearest_`.
  [[nodiscard]] double distance(const Eigen::Vector2d& place) const {
    return std::max(plane_ - along_at(place), nearest_);
  }

  /// Of a part's picture, model units squared; of what has a place there.
  [[nodiscard]] double picture_area(Polygons::Points part) const {
    const auto ahead = [&](const Eigen::Vector2d& place) {
      return plane_ - along_at(place) - nearest_;
    };
    if (nearest_ > 0.0 && std::any_of(part.begin(), part.end(),
                                      [&](const auto& place) { return ahead(place) < 0.0; })) {
      std::vector<Eigen::Vector2d> rest;
      cut_polygon(part, ahead, rest, [](const Eigen::Vector2d&) {});
      return whole_picture_area(rest);
    }
    return whole_picture_area(part);
  }

  /// Of a triangle it is ½ d² |det (a, b, c)| / (a_z b_z c_z), d being the distance of the plane.
  [[nodiscard]] double whole_picture_area(Polygons::Points part) const {
    double sum = 0.0;
    for (std::size_t k = 2; k < part.size(); ++k) {
      const double share = cross(part[k - 1] - part[0], part[k] - part[0]);
      sum += is_perspective_
                 ? share / (distance(part[0]) * distance(part[k - 1]) * distance(part[k]))
                 : share;
    }
    return picture_ * sum;
  }

  /// Adds the picture of a part to the bins that it reaches.
  void spread(Polygons::Points part, double first, double high, double projected) {
    polygon_.assign(part.begin(), part.end());
    double left = projected;
    for (double k = first; k + 1.0 < high && polygon_.size() > 2; ++k) {
      farther_.clear();
      cut_polygon(
          polygon_,
          [&](const Eigen::Vector2d& place) { return k + 1.0 - depth_at(along_at(place)) * kBins; },
          nearer_, [this](const Eigen::Vector2d& place) { farther_.push_back(place); });
      const double here = picture_area(nearer_);
      result_.depths[bin(k)] += here;
      left -= here;
      std::swap(polygon_, farther_);
    }
    result_.depths[bin(std::ceil(high) - 1.0)] += std::max(left, 0.0);
  }

  const Surface& surface_;
  const Viewpoint& local_;
  bool is_perspective_;
  Vec3 towards_ = Vec3::UnitZ();  // unit, from the sphere's centre to the eye
  double per_diameter_;           // one over the sphere's, in units of the frame
  double to_model_;               // from twice an area in the frame to an area in the model
  double plane_ = 0.0;            // how far the eye is from the plane of projection
  double nearest_ = 0.0;          // along the line of sight, of what has a place in the picture
  std::vector<double>& along_;    // of each sample, from the centre to the eye
  SeenSurface& result_;
  std::array<double, 3> at_corner_{};  // of those of the face at hand
  double area_ = 0.0;                  // of the face at hand
  double picture_ = 0.0;               // area of its picture, but for the distances of its corners
  std::vector<Eigen::Vector2d> polygon_{}, nearer_{}, farther_{};  // of the part at hand
};

}  // namespace vantage
