// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/vec3.h"

/// \file
/// Cameras, in model coordinates. Right-handed; a camera looks along −z of its own frame.

namespace vantage {

/// How space is mapped to a picture.
enum class Projection { Perspective, Orthographic };

/// Where the surface is seen from: a point, or a direction at infinity.
struct Viewpoint {
  Projection projection = Projection::Perspective;  ///< How space is mapped.
  Vec3 position = Vec3::UnitZ();  ///< Perspective: the eye. Orthographic: unit vector to the eye.
};

/// A camera that can take a picture.
struct Camera {
  Projection projection = Projection::Perspective;  ///< How space is mapped.
  Vec3 eye = Vec3::UnitZ();                         ///< Position of the camera.
  Vec3 target = Vec3::Zero();  ///< The point at the centre of the picture; differs from eye.
  Vec3 up = Vec3::UnitY();     ///< Unit, orthogonal to target − eye.
  double fov_y_deg = 30.0;     ///< Perspective: full vertical field of view, in (0, 180).
  double height = 2.0;         ///< Orthographic: height of the picture in model units, > 0.
};

}  // namespace vantage
