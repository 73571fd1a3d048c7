// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

#include "core/unit_direction.h"
#include "render/picture_room.h"

namespace vantage {
namespace {

/// Half-angle of the cone around the poles in which up turns to a fixed axis (ours).
constexpr double kPoleConeRad = 5.0 * std::numbers::pi / 180.0;
/// Below this the sideways part of a unit vector is rounding, not a direction.
constexpr double kNegligible = 1e-12;
/// Centring stops when the box is off centre by less than this fraction of its size: far below a
/// pixel of any picture.
constexpr double kCentred = 1e-10;
constexpr int kMaxCentringSteps = 100;
/// Turning by a smaller part of the way than this helps no more.
constexpr double kLeastTurn = 1e-3;
/// Largest and smallest tangent of half the field of view: 170° and about 0.1 seconds of arc.
constexpr double kMaxTangent = 11.43;
constexpr double kMinTangent = 2.5e-7;

/// Horizontal axis that a person standing in front of the model looks along, turned round.
Vec3 front_of(const Vec3& model_up) {
  const bool z_is_up = std::abs(model_up.z()) > 0.9;
  const Vec3 axis = z_is_up ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  return (axis - axis.dot(model_up) * model_up).normalized();
}

Vec3 orthogonal_part(const Vec3& vector, const Vec3& unit) {
  return vector - vector.dot(unit) * unit;
}

/// Picture axes: right, up, and the line of sight.
struct Axes {
  Vec3 right;
  Vec3 up;
  Vec3 forward;
};

Axes axes_along(const Vec3& forward, const Vec3& up_hint) {
  Axes axes;
  axes.forward = forward;
  axes.right = forward.cross(up_hint).normalized();
  axes.up = axes.right.cross(forward);
  return axes;
}

/// Bounds of the points in the picture; `in_front` is false if a point cannot be projected.
struct Bounds {
  double low_x = std::numeric_limits<double>::infinity();
  double high_x = -std::numeric_limits<double>::infinity();
  double low_y = std::numeric_limits<double>::infinity();
  double high_y = -std::numeric_limits<double>::infinity();
  bool in_front = true;

  void add(double x, double y) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  }

  [[nodiscard]] double centre_x() const { return 0.5 * (low_x + high_x); }

  [[nodiscard]] double centre_y() const { return 0.5 * (low_y + high_y); }
};

Bounds perspective_bounds(std::span<const Vec3> points, const Vec3& eye, const Axes& axes) {
  Bounds bounds;
  for (const Vec3& point : points) {
    const Vec3 offset = point - eye;
    const double depth = offset.dot(axes.forward);
    if (!(depth > kNegligible * offset.norm())) {
      bounds.in_front = false;
      return bounds;
    }
    bounds.add(offset.dot(axes.right) / depth, offset.dot(axes.up) / depth);
  }
  return bounds;
}

/// Half the picture's height that just holds a centred box of these half-sizes.
double half_height(const Bounds& bounds, const Room& room) {
  return std::max(0.5 * (bounds.high_x - bounds.low_x) / room.x,
                  0.5 * (bounds.high_y - bounds.low_y) / room.y);
}

/// Aspect of a box with a border of `margin` of the picture's shorter side, the inverse of room_for().
/// \param least sides below it are 0.
double aspect_with_margin(double width, double height, double least, double margin) {
  if (std::max(width, height) < least) {
    return 1.0;
  }
  const double longer = std::max(width, height);
  const double shorter = std::min(width, height);
  // room_for(): shorter / longer of the box = (1 - 2 m) / (a - 2 m), with the picture's a >= 1.
  const double a = (1.0 - 2.0 * margin) * longer / shorter + 2.0 * margin;
  return width >= height ? a : 1.0 / a;
}

void check_arguments(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                     double aspect, double margin) {
  if (points.empty()) {
    throw InvalidInput("framing needs at least one point");
  }
  if (!(aspect > 0.0) || !std::isfinite(aspect)) {
    throw InvalidInput("framing needs an aspect (width over height) above 0");
  }
  if (!(margin >= 0.0 && margin < 0.5)) {
    throw InvalidInput("framing needs a margin in [0, 0.5)");
  }
  const bool eye_is_valid = eye.projection == Projection::Perspective
                                ? (eye.position - centre).norm() > 0.0
                                : unit_vector(eye.position).has_value();
  if (!eye_is_valid || !eye.position.allFinite() || !centre.allFinite()) {
    throw InvalidInput("framing needs an eye that is finite and away from the model's centre");
  }
  if (!std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); })) {
    throw InvalidInput("framing needs finite points");
  }
}

[[noreturn]] void throw_too_near() {
  throw InvalidInput(
      "the eye is inside the model or too near to see all of it; move it further away");
}

/// Line of sight to start from: to the centre, or to the mean direction if points lie behind that.
Vec3 first_forward(std::span<const Vec3> points, const Vec3& eye, const Vec3& centre,
                   const Vec3& up) {
  Vec3 forward = (centre - eye).normalized();
  if (perspective_bounds(points, eye, axes_along(forward, up)).in_front) {
    return forward;
  }
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) {
    sum += (point - eye).normalized();
  }
  if (!(sum.norm() > kNegligible * static_cast<double>(points.size()))) {
    throw_too_near();
  }
  return sum.normalized();
}

/// How far the middle of the box is from the middle of the picture, over the box's size.
double off_centre(const Bounds& bounds, const Room& room) {
  return std::max(std::abs(bounds.centre_x()), std::abs(bounds.centre_y())) /
         std::max(half_height(bounds, room), kMinTangent);
}

/// Turns the camera about the eye until the points' box is in the middle of the picture. Turning
/// changes the picture plane and with it the box, so this repeats: by the mean of the angles to
/// opposite sides, which would be exact for points on one axis, or by less while that does not help.
Axes centred_axes(std::span<const Vec3> points, const Vec3& eye, const Vec3& first,
                  const Vec3& up_hint, const Room& room) {
  Axes axes = axes_along(first, up_hint);
  Bounds bounds = perspective_bounds(points, eye, axes);
  if (!bounds.in_front) {
    throw_too_near();
  }
  double part = 1.0;
  for (int step = 0; step < kMaxCentringSteps && part > kLeastTurn; ++step) {
    const double error = off_centre(bounds, room);
    if (error <= kCentred) {
      break;
    }
    const double x = std::tan(0.5 * part * (std::atan(bounds.low_x) + std::atan(bounds.high_x)));
    const double y = std::tan(0.5 * part * (std::atan(bounds.low_y) + std::atan(bounds.high_y)));
    const Axes turned =
        axes_along((axes.forward + x * axes.right + y * axes.up).normalized(), up_hint);
    const Bounds turned_bounds = perspective_bounds(points, eye, turned);
    if (turned_bounds.in_front && off_centre(turned_bounds, room) < error) {
      axes = turned;
      bounds = turned_bounds;
      part = std::min(1.0, 2.0 * part);
    } else {
      part *= 0.5;
    }
  }
  return axes;
}

/// Axes in whose middle the points are.
Axes perspective_axes(std::span<const Vec3> points, const Vec3& eye, const Vec3& centre,
                      const Vec3& model_up, const Room& room) {
  const Vec3 up_hint = upright((eye - centre).normalized(), model_up);
  return centred_axes(points, eye, first_forward(points, eye, centre, up_hint), up_hint, room);
}

Camera frame_perspective(std::span<const Vec3> points, const Vec3& eye, const Vec3& centre,
                         const Vec3& model_up, const Room& room) {
  const Axes axes = perspective_axes(points, eye, centre, model_up, room);
  const Bounds bounds = perspective_bounds(points, eye, axes);
  // Measured from the axis, so that nothing is clipped even if the centring ended early.
  const double tangent = std::max(std::max(bounds.high_x, -bounds.low_x) / room.x,
                                  std::max(bounds.high_y, -bounds.low_y) / room.y);
  if (tangent > kMaxTangent) {
    const double widest = std::max({bounds.high_x, -bounds.low_x, bounds.high_y, -bounds.low_y});
    if (room.x < room.y && widest < kMaxTangent * room.y) {
      throw InvalidInput(
          "the picture is so narrow that it would need a field of view beyond 170°; take a wider "
          "one, or an orthographic camera");
    }
    throw_too_near();
  }
  const double depth = (centre - eye).dot(axes.forward);
  Camera camera;
  camera.projection = Projection::Perspective;
  camera.eye = eye;
  camera.target = eye + (depth > 0.0 ? depth : (centre - eye).norm()) * axes.forward;
  camera.up = axes.up;
  camera.fov_y_deg = 2.0 * std::atan(std::max(tangent, kMinTangent)) * 180.0 / std::numbers::pi;
  return camera;
}

/// Points in a parallel projection: their bounds about the centre, and where the eye can stand.
struct ParallelExtent {
  Bounds bounds{};
  double nearest = 0.0;  ///< Of all points, towards the eye.
  double scale = 1.0;    ///< Distance of the farthest point, above 0.
};

ParallelExtent parallel_extent(std::span<const Vec3> points, const Vec3& direction,
                               const Vec3& centre, const Axes& axes) {
  ParallelExtent extent;
  double reach = 0.0;
  for (const Vec3& point : points) {
    const Vec3 offset = point - centre;
    extent.bounds.add(offset.dot(axes.right), offset.dot(axes.up));
    extent.nearest = std::max(extent.nearest, offset.dot(direction));
    reach = std::max(reach, offset.norm());
  }
  extent.scale = reach > 0.0 ? reach : 1.0;
  return extent;
}

Camera frame_orthographic(std::span<const Vec3> points, const Vec3& direction, const Vec3& centre,
                          const Vec3& model_up, const Room& room) {
  const Axes axes = axes_along(-direction, upright(direction, model_up));
  const auto [bounds, nearest, scale] = parallel_extent(points, direction, centre, axes);
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.target = centre + bounds.centre_x() * axes.right + bounds.centre_y() * axes.up;
  camera.eye = camera.target + (nearest + scale) * direction;
  camera.up = axes.up;
  camera.height = 2.0 * std::max(half_height(bounds, room), kMinTangent * scale);
  return camera;
}

}  // namespace

Vec3 upright(const Vec3& direction, const Vec3& model_up) {
  const Vec3 to_eye = unit_direction(direction);
  const Vec3 up = unit_direction(model_up);
  const Vec3 radial = orthogonal_part(up, to_eye);
  const double sine = radial.norm();
  const bool above = to_eye.dot(up) > 0.0;
  if (sine >= std::sin(kPoleConeRad)) {
    return radial / sine;
  }
  const Vec3 front = front_of(up);
  Vec3 fixed = orthogonal_part(above ? Vec3(-front) : front, to_eye).normalized();
  if (sine <= kNegligible) {
    return fixed;
  }
  const Vec3 side = to_eye.cross(fixed);
  const double across = radial.dot(side) / sine;
  // From exactly behind both ways round are as long; rounding must not choose.
  const double turn =
      std::atan2(std::abs(across) <= kNegligible ? 0.0 : across, radial.dot(fixed) / sine);
  const double t = std::asin(sine) / kPoleConeRad;
  const double angle = turn * t * t * (3.0 - 2.0 * t);
  return std::cos(angle) * fixed + std::sin(angle) * side;
}

Camera frame_points(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                    const Vec3& model_up, double aspect, double margin) {
  check_arguments(points, eye, centre, aspect, margin);
  const Room room = room_for(aspect, margin);
  if (eye.projection == Projection::Orthographic) {
    return frame_orthographic(points, unit_direction(eye.position).normalized(), centre, model_up,
                              room);
  }
  return frame_perspective(points, eye.position, centre, model_up, room);
}

double least_distance(double margin) {
  return std::hypot(1.0, 1.0 / (kMaxTangent * room_for(1.0, margin).y));
}

double fitting_aspect(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                      const Vec3& model_up, double margin) {
  check_arguments(points, eye, centre, 1.0, margin);
  Bounds bounds;
  double least = kMinTangent;
  if (eye.projection == Projection::Orthographic) {
    const Vec3 direction = unit_direction(eye.position).normalized();
    const ParallelExtent extent = parallel_extent(
        points, direction, centre, axes_along(-direction, upright(direction, model_up)));
    bounds = extent.bounds;
    least *= extent.scale;
  } else {
    const Axes axes =
        perspective_axes(points, eye.position, centre, model_up, room_for(1.0, margin));
    bounds = perspective_bounds(points, eye.position, axes);
  }
  return aspect_with_margin(bounds.high_x - bounds.low_x, bounds.high_y - bounds.low_y, least,
                            margin);
}

}  // namespace vantage
