// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/measures.h"
#include "vantage/visibility/face_visibility.h"

#include "visibility/polygon_rest.h"
#include "visibility/surface.h"

/// \file
/// Areas, areas in the picture and depths of what is seen, added up face by face. Inline, as it is
/// asked about every piece of every view.

namespace vantage {

/// Depth along the line of sight to the middle of the enclosing sphere.
struct Depths {
  Depths(const Surface& surface, const Sphere& sphere, const Viewpoint& local)
      : centre(surface.frame.to_frame(sphere.centre)),
        towards(local.projection == Projection::Perspective
                    ? Vec3((local.position - centre).normalized())
                    : local.position),
        per_diameter(1.0 / (sphere.diameter * surface.frame.scale)) {}

  /// From the side of the sphere next to the eye, over its diameter.
  [[nodiscard]] double at(const Vec3& place) const {
    return std::clamp(0.5 - (place - centre).dot(towards) * per_diameter, 0.0, 1.0);
  }

  Vec3 centre;          ///< Of the sphere.
  Vec3 towards;         ///< Unit, from there to the eye.
  double per_diameter;  ///< One over the sphere's.
};

/// For one view.
class Tally {
 public:
  Tally(const Surface& surface, const Depths& depths, const Viewpoint& local, SeenSurface& result)
      : surface_(surface),
        local_(local),
        is_perspective_(local.projection == Projection::Perspective),
        depths_(depths),
        plane_((local.position - depths.centre).dot(depths.towards)),
        result_(result),
        has_(surface.faces.size(), 0) {}

  /// Whether something of a face was added.
  [[nodiscard]] bool has(std::size_t face) const { return has_[face] != 0; }

  /// Adds a part of a face, by its centroid. \pre faces come one after the other.
  /// \param area model units squared.
  void add(std::uint32_t face, const Vec3& place, double area) {
    begin(face);
    const double projected = area * scale_ * shrink(place);
    const double depth = depths_.at(place);
    result_.faces.back().visible_area += area;
    result_.faces.back().projected_area += projected;
    spread(projected, depth, area);
    result_.deepest = std::max(result_.deepest, depth);
  }

  /// Adds a convex part of a face, exactly. \pre the same.
  void add(std::uint32_t face, std::span<const Vec3> corners, double area) {
    begin(face);
    polygon_.assign(corners.begin(), corners.end());
    double low = kBins;
    double high = 0.0;
    for (const Vec3& corner : corners) {
      const double depth = depths_.at(corner);
      low = std::min(low, depth * kBins);
      high = std::max(high, depth * kBins);
      result_.deepest = std::max(result_.deepest, depth);
    }
    const double projected = picture_area(polygon_);
    result_.faces.back().visible_area += area;
    result_.faces.back().projected_area += projected;
    double left = projected;
    for (double k = std::floor(low); k + 1.0 < high; ++k) {
      cut_polygon(
          polygon_, [&](const Vec3& place) { return k + 1.0 - depths_.at(place) * kBins; }, nearer_,
          [this](const Vec3& place) { farther_.push_back(place); });
      const double here = nearer_.size() > 2 ? picture_area(nearer_) : 0.0;
      result_.depths[static_cast<std::size_t>(k)] += here;
      left -= here;
      std::swap(polygon_, farther_);
      farther_.clear();
      if (polygon_.size() < 3) {
        break;
      }
    }
    const double last = std::clamp(std::ceil(high) - 1.0, 0.0, kBins - 1.0);
    result_.depths[static_cast<std::size_t>(last)] += std::max(left, 0.0);
  }

  /// Counts the deeper end of what is seen of an edge. \param half from its middle to an end.
  void reach(const Vec3& middle, const Vec3& half) {
    result_.deepest =
        std::max({result_.deepest, depths_.at(middle + half), depths_.at(middle - half)});
  }

 private:
  /// Makes ready for parts of a face.
  void begin(std::uint32_t face) {
    if (face == last_) {
      return;
    }
    last_ = face;
    has_[face] = 1;
    normal_ = &surface_.area_vectors[face];
    // Finite even for faces of next to no area.
    scale_ =
        std::min((is_perspective_ ? plane_ * plane_ : 1.0) / surface_.twice_areas[face], 1e300);
    steepness_ = steepness();
    result_.faces.push_back({.face = surface_.face_of_mesh[face]});
  }

  /// Of the polygon's picture, model units squared; 0 if not all of it is ahead of the eye.
  [[nodiscard]] double picture_area(const std::vector<Vec3>& polygon) const {
    if (is_perspective_ && std::any_of(polygon.begin(), polygon.end(), [this](const Vec3& corner) {
          return !((local_.position - corner).dot(depths_.towards) > 0.0);
        })) {
      return 0.0;
    }
    double twice = 0.0;
    const auto place = [&](const Vec3& corner) {
      const Vec3 from_eye = corner - local_.position;
      return is_perspective_ ? Vec3(from_eye * (plane_ / -from_eye.dot(depths_.towards))) : corner;
    };
    const Vec3 first = place(polygon[0]);
    Vec3 before = place(polygon[1]) - first;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vec3 here = place(polygon[k]) - first;
      twice += before.cross(here).dot(depths_.towards);
      before = here;
    }
    const double unit = surface_.frame.scale;
    return 0.5 * std::abs(twice) / (unit * unit);
  }

  static constexpr auto kBins = static_cast<double>(SeenSurface::kDepthBins);

  /// Squared half of the bins that a part of the face at hand reaches, over its area: √3 deviations
  /// to either side, where an equilateral triangle's variance is area / (6 √3) along any line.
  [[nodiscard]] double steepness() const {
    const double twice = surface_.twice_areas[last_];
    const double along = normal_->dot(depths_.towards) / twice;
    const double bins = kBins * surface_.frame.scale * depths_.per_diameter;
    return twice > 0.0 ? std::max(0.0, 1.0 - along * along) * bins * bins / (2.0 * std::sqrt(3.0))
                       : 0.0;
  }

  /// Adds to the bins that a part reaches, as if its depth were spread evenly about the middle, by
  /// its variance: else the rings of a torus go to one bin or to the other at once.
  void spread(double projected, double depth, double area) {
    const double at = depth * kBins;
    const auto bin = static_cast<std::size_t>(std::min(at, kBins - 1.0));
    const double past = at - static_cast<double>(bin);
    const double to_edge = std::min(past, 1.0 - past);
    const double squared_half = steepness_ * area;
    if (squared_half <= to_edge * to_edge) {
      result_.depths[bin] += projected;
      return;
    }
    const double half = std::sqrt(squared_half);
    const double low = std::max(at - half, 0.0);
    const double high = std::min(at + half, kBins);
    if (!(low < high)) {  // less than rounding
      result_.depths[bin] += projected;
      return;
    }
    for (double k = std::floor(low); k < high; ++k) {
      const double share = (std::min(high, k + 1.0) - std::max(low, k)) / (high - low);
      result_.depths[static_cast<std::size_t>(k)] += share * projected;
    }
  }

  /// Projected area over area and `scale_`, at a place of the face at hand.
  [[nodiscard]] double shrink(const Vec3& place) const {
    if (!is_perspective_) {
      return std::abs(normal_->dot(depths_.towards));
    }
    const Vec3 sight_line = local_.position - place;
    const double depth = sight_line.dot(depths_.towards);
    return depth > 0.0 ? std::abs(normal_->dot(sight_line)) / (depth * depth * depth) : 0.0;
  }

  const Surface& surface_;
  const Viewpoint& local_;
  bool is_perspective_;
  const Depths& depths_;
  double plane_;  // how far the eye is from the plane of projection
  SeenSurface& result_;
  std::vector<std::uint8_t> has_;  // of each face
  std::uint32_t last_ = Surface::kNoSite;
  const Vec3* normal_ = nullptr;  // of the face at hand, as long as twice its area
  double steepness_ = 0.0;        // of the face at hand
  double scale_ = 1.0;            // makes up for that, and for the plane's distance
  std::vector<Vec3> polygon_{}, nearer_{}, farther_{};  // of the part at hand
};

}  // namespace vantage
