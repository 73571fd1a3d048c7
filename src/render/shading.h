// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/vec3.h"

namespace vantage {

/// What is seen at one point, in linear light and in the camera's axes (x right, y up, z back).
struct SurfacePoint {
  Vec3 normal = Vec3::UnitZ();     ///< Unit, on the viewer's side.
  Vec3 to_viewer = Vec3::UnitZ();  ///< Unit.
  Vec3 albedo = Vec3::Ones();      ///< Linear, in [0, 1].
  double openness = 1.0;           ///< Unblocked part of the sky over the point, in [0, 1].
};

/// The albedo that a surface is shown with. Below 0.06 its brightest channel is lifted, that of black to
/// 0.03: dark colours differ as before and keep their hue, but light and shade can be told on them.
Vec3 lifted_from_black(const Vec3& albedo);

/// Linear colour of a matt surface with a soft sheen under a key light from the upper left over the
/// viewer's shoulder, a weak light from the lower right, a sky, and a rim light. The lights belong to
/// the camera: every view is well lit. Bright colours are compressed towards 1 with hue kept.
Vec3 shade_surface(const SurfacePoint& point);

/// Linear colour of paper with a wash of shade, for drawings whose lines carry the form.
Vec3 shade_drawing(const SurfacePoint& point);

/// The same light on the smoother, outlined material of overlaid tubes.
Vec3 shade_tube(const SurfacePoint& point);

/// How opaque a translucent surface looks: least where seen straight on, most at its outline, as
/// glass is; and less in front of a tube, which it should only veil.
double translucent_opacity(const SurfacePoint& point, bool before_tube);

}  // namespace vantage
