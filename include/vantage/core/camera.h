// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/vec3.h"

/// \file
/// Cameras and the frame of a model that stands upright, in model coordinates. Right-handed; a camera looks
/// along −z of its own frame.

namespace vantage {

/// How space is mapped to a picture.
enum class Projection { Perspective, Orthographic };

/// Where the surface is seen from: a point, or a direction at infinity.
struct Viewpoint {
  Projection projection = Projection::Perspective;  ///< How space is mapped.
  Vec3 position = Vec3::UnitZ();  ///< Perspective: the eye. Orthographic: direction to the eye.
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

/// A model's own axes: an orthonormal, right-handed frame (side = up × front).
struct UprightFrame {
  Vec3 side = Vec3::UnitX();   ///< To the right of a viewer in front.
  Vec3 up = Vec3::UnitY();     ///< Against gravity.
  Vec3 front = Vec3::UnitZ();  ///< Toward a viewer in front.
};

/// The frame of a model whose up is an axis of its coordinates. Its front is what most files of
/// that up axis mean by it: +z when y is up (glTF, OBJ) or x is, −y when z is up (CAD, Blender).
/// \param up a direction, nearest axis decides. \throw InvalidInput if it is zero or not finite
UprightFrame upright_frame(const Vec3& up);
/// The frame of a model whose up and front are known: directions at right angles. \throw InvalidInput if
/// they are not, or one is zero or not finite
UprightFrame upright_frame(const Vec3& up, const Vec3& front);

}  // namespace vantage
