// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

#include "visibility/surface.h"

/// \file
/// Where the sites of a surface are in an eye's picture, in double.

namespace vantage {

/// From a place to the eye, or towards it.
inline Vec3 sight_line(const Vec3& place, const Viewpoint& eye) {
  return eye.projection == Projection::Perspective ? Vec3(eye.position - place) : eye.position;
}

/// On a plane across the line of sight.
struct SitePicture {
  using Box = Eigen::AlignedBox2d;

  std::vector<Eigen::Vector2d> places{};  ///< Of each site.
  /// Of each site, larger for what is nearer to the eye; linear over a plane's picture.
  std::vector<double> nearness{};
  bool is_whole = true;  ///< All of them are ahead of the eye; else there is none.

  SitePicture(const Surface& surface, const Viewpoint& eye) {
    const bool is_perspective = eye.projection == Projection::Perspective;
    const Vec3 towards = eye.position.normalized();
    const Vec3 right = towards.unitOrthogonal();
    const Vec3 up = towards.cross(right);
    places.reserve(surface.sites.size());
    nearness.reserve(surface.sites.size());
    for (const Vec3& site : surface.sites) {
      const double depth = is_perspective ? (eye.position - site).dot(towards) : 1.0;
      is_whole = is_whole && depth > 0.0;
      places.emplace_back(site.dot(right) / depth, site.dot(up) / depth);
      nearness.push_back(is_perspective ? 1.0 / depth : site.dot(towards));
    }
  }

  /// Of an edge's ends, or of a face's corners.
  template <std::size_t Count>
  [[nodiscard]] Box box(const std::array<std::uint32_t, Count>& sites) const {
    Box box;
    for (const std::uint32_t site : sites) {
      box.extend(places[site]);
    }
    return box;
  }
};

}  // namespace vantage
