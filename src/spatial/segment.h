// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

/// \file
/// Does a triangle block the segment from a vertex to the eye? Decided in double precision, and
/// without gaps: of two triangles that share an edge at least one blocks a segment through it.

namespace vantage {

/// A segment (or half-line) from a vertex, made ready for many triangles. Space is translated to
/// the vertex and sheared so that the segment runs along one axis; a triangle is then a flat one
/// that may or may not hold the origin. Woop, Benthin, Wald, "Watertight Ray/Triangle
/// Intersection", JCGT 2013; unlike there all arithmetic is double and a zero edge value counts
/// as inside. Every corner is rounded to the same flat point for all faces that use it, and the
/// comparison of two rounded products is never wrong but for calling a difference zero: so the
/// flat triangles of a closed surface leave no gap.
class Segment {
 public:
  /// \param start     the vertex.
  /// \param direction to the eye; for a bounded segment start + direction is the eye. Not zero.
  /// \param bounded   false: the eye is at infinity.
  Segment(const Vec3& start, const Vec3& direction, bool bounded)
      : start_(start), bounded_(bounded) {
    direction.cwiseAbs().maxCoeff(&z_axis_);
    x_axis_ = z_axis_ == 2 ? 0 : z_axis_ + 1;
    y_axis_ = x_axis_ == 2 ? 0 : x_axis_ + 1;
    length_ = direction[z_axis_];
    shear_x_ = direction[x_axis_] / length_;
    shear_y_ = direction[y_axis_] / length_;
  }

  /// Whether the triangle abc crosses the segment strictly between its ends. A triangle that
  /// only touches the start or the eye does not. \param twice_area |(b − a) × (c − a)|.
  [[nodiscard]] bool crosses(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) const {
    const Flat A = flat(a);
    const Flat B = flat(b);
    const Flat C = flat(c);
    const double u = B.x * C.y - C.x * B.y;
    const double v = C.x * A.y - A.x * C.y;
    const double w = A.x * B.y - B.x * A.y;
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) {
      return false;
    }
    const double area = u + v + w;
    if (area == 0.0) {
      return false;  // seen edge on: the faces beside it decide
    }
    // Depth of the crossing along the axis, times the area; also the volume spanned with the start,
    // that is twice_area times the start's distance from the triangle's plane.
    const double volume = u * A.z + v * B.z + w * C.z;
    const double contact = kContact * twice_area;
    if (std::abs(volume) <= contact) {
      return false;
    }
    const double reach = area * length_;
    const bool ahead = (volume > 0.0) == (reach > 0.0);
    return ahead && (!bounded_ || std::abs(reach) - std::abs(volume) > contact);
  }

  /// An end this close to a triangle's plane touches it. In units of a UnitFrame, whose
  /// coordinates are below 1 and carry rounding errors of 2^-53: some tens of them.
  static constexpr double kContact = 0x1p-47;

 private:
  struct Flat {
    double x, y, z;
  };

  [[nodiscard]] Flat flat(const Vec3& corner) const {
    const double z = corner[z_axis_] - start_[z_axis_];
    return {corner[x_axis_] - start_[x_axis_] - shear_x_ * z,
            corner[y_axis_] - start_[y_axis_] - shear_y_ * z, z};
  }

  Vec3 start_;
  bool bounded_;
  Eigen::Index x_axis_ = 0;
  Eigen::Index y_axis_ = 0;
  Eigen::Index z_axis_ = 0;
  double length_ = 0.0;
  double shear_x_ = 0.0;
  double shear_y_ = 0.0;
};

/// The segment from a point to an eye that is elsewhere.
inline Segment segment_to(const Vec3& point, const Viewpoint& eye) {
  const bool bounded = eye.projection == Projection::Perspective;
  return {point, bounded ? Vec3(eye.position - point) : eye.position, bounded};
}

}  // namespace vantage
