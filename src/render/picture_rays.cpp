// SPDX-License-Identifier: MIT
#include "render/picture_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"

namespace vantage {
namespace {

/// Rays start this much before the scene's ball, relative to its radius: more than rounding.
constexpr double kBeforeBall = 1e-3;
/// A sine below this between up and the line of sight leaves the picture's turn undefined.
constexpr double kMinUpSine = 1e-9;

}  // namespace

PictureRays::PictureRays(const Camera& camera, const UnitFrame& frame, double reach, int width,
                         int height)
    : eye_(frame.to_frame(camera.eye)),
      perspective_(camera.projection == Projection::Perspective),
      reach_(reach),
      width_(width),
      height_(height) {
  const Vec3 sight = camera.target - camera.eye;
  if (!sight.allFinite() || !(sight.norm() > 0.0)) {
    throw InvalidInput("the camera's eye and target must be finite and apart");
  }
  back_ = -sight.normalized();
  const Vec3 side = camera.up.cross(back_);
  if (!(side.norm() > kMinUpSine * camera.up.norm())) {
    throw InvalidInput("the camera's up vector must not point along its line of sight");
  }
  right_ = side.normalized();
  up_ = back_.cross(right_);
  if (perspective_ && !(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0)) {
    throw InvalidInput("the camera's field of view must be between 0 and 180 degrees");
  }
  if (!perspective_ && !(camera.height > 0.0 && std::isfinite(camera.height))) {
    throw InvalidInput("the orthographic camera's height must be above 0");
  }
  half_height_ = perspective_ ? std::tan(camera.fov_y_deg * std::numbers::pi / 360.0)
                              : 0.5 * camera.height * frame.scale;
  half_width_ = half_height_ * static_cast<double>(width) / static_cast<double>(height);
}

PictureRay PictureRays::ray(double x, double y) const {
  const double across = (2.0 * x / width_ - 1.0) * half_width_;
  const double along = (1.0 - 2.0 * y / height_) * half_height_;
  const Vec3 shift = across * right_ + along * up_;
  PictureRay ray;
  ray.direction = perspective_ ? Vec3(shift - back_).normalized() : Vec3(-back_);
  const Vec3 start = perspective_ ? eye_ : Vec3(eye_ + shift);
  const double nearest_t = -start.dot(ray.direction);
  const Vec3 nearest = start + nearest_t * ray.direction;
  ray.can_hit = nearest.norm() <= reach_ && (!perspective_ || nearest_t >= -reach_);
  const double enter = nearest_t - (1.0 + kBeforeBall) * reach_;
  ray.origin = start + (perspective_ ? std::max(enter, 0.0) : enter) * ray.direction;
  return ray;
}

std::optional<std::array<double, 2>> PictureRays::place_of(const Vec3& point) const {
  constexpr double kLeastDepth = 1e-3;  // over the scene's radius
  const Vec3 offset = point - eye_;
  const double depth = perspective_ ? -offset.dot(back_) : 1.0;
  if (!(depth > kLeastDepth * reach_) && perspective_) {
    return std::nullopt;
  }
  return std::array{0.5 * width_ * (1.0 + offset.dot(right_) / (depth * half_width_)),
                    0.5 * height_ * (1.0 - offset.dot(up_) / (depth * half_height_))};
}

PixelBox PictureRays::bounds(const Vec3& begin, const Vec3& end, double radius) const {
  // A box of space along the picture's axes, of which only what is before the eye counts.
  Eigen::Matrix3d axes;
  axes << right_.transpose(), up_.transpose(), -back_.transpose();
  const Vec3 from = axes * (begin - eye_);
  const Vec3 to = axes * (end - eye_);
  const Vec3 low = from.cwiseMin(to) - Vec3::Constant(radius);
  const Vec3 high = from.cwiseMax(to) + Vec3::Constant(radius);
  if (perspective_ && high.z() <= 0.0) {
    return {};
  }
  const double beside = std::numeric_limits<double>::infinity();
  const double near = !perspective_ ? 1.0 : low.z() > 0.0 ? 1.0 / low.z() : beside;
  const double far = perspective_ ? 1.0 / high.z() : 1.0;
  const auto least = [&](double value) { return value * (value < 0.0 ? near : far); };
  const auto most = [&](double value) { return -least(-value); };
  const auto pixel = [](double fraction, int size) {
    return static_cast<int>(std::clamp(fraction, -1.0, 2.0) * size);
  };
  const double w = 2.0 * half_width_;
  const double h = 2.0 * half_height_;
  // Two pixels to spare: one for rounding down, one for samples taken beside their pixel.
  PixelBox box{
      pixel(0.5 + least(low.x()) / w, width_) - 2, pixel(0.5 - most(high.y()) / h, height_) - 2,
      pixel(0.5 + most(high.x()) / w, width_) + 3, pixel(0.5 - least(low.y()) / h, height_) + 3};
  box.x0 = std::clamp(box.x0, 0, width_);
  box.x1 = std::clamp(box.x1, 0, width_);
  box.y0 = std::clamp(box.y0, 0, height_);
  box.y1 = std::clamp(box.y1, 0, height_);
  return box;
}

}  // namespace vantage
