// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// A ray of a picture, in the scene's unit frame.
struct PictureRay {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  ///< Unit.
  bool can_hit = false;            ///< False if it passes the whole scene by.

  [[nodiscard]] RaySegment segment() const {
    return {origin.cast<float>(), direction.cast<float>()};
  }
};

/// A pixel range [x0, x1) × [y0, y1).
struct PixelBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  [[nodiscard]] bool is_empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Turns picture coordinates into rays and back, in the scene's unit frame.
class PictureRays {
 public:
  /// \param reach everything drawn lies within this distance of the frame's origin.
  /// \throw InvalidInput if the camera is not a valid one.
  PictureRays(const Camera& camera, const UnitFrame& frame, double reach, int width, int height);

  /// The ray through the point (x, y) of the picture, in pixels from its top left corner. It starts
  /// where it can first meet the scene, so that single precision holds however far the eye is; an
  /// orthographic one starts before the model even if that is behind the eye.
  [[nodiscard]] PictureRay ray(double x, double y) const;

  /// Where a point falls, pixels from the top left corner; nothing if it is not well before the eye.
  [[nodiscard]] std::optional<std::array<double, 2>> place_of(const Vec3& point) const;

  /// Pixels that what is nowhere farther than `radius` from a segment may touch; never too few.
  [[nodiscard]] PixelBox bounds(const Vec3& begin, const Vec3& end, double radius) const;

  [[nodiscard]] const Vec3& right() const { return right_; }

  [[nodiscard]] const Vec3& up() const { return up_; }

  [[nodiscard]] const Vec3& back() const { return back_; }  ///< Against the line of sight.

 private:
  Vec3 eye_ = Vec3::Zero();
  Vec3 right_ = Vec3::UnitX();
  Vec3 up_ = Vec3::UnitY();
  Vec3 back_ = Vec3::UnitZ();
  bool perspective_ = true;
  double reach_ = 1.0;
  double half_width_ = 1.0;  ///< At depth 1, or in frame units if orthographic.
  double half_height_ = 1.0;
  int width_ = 1;
  int height_ = 1;
};

}  // namespace vantage
