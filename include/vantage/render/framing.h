// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

/// \file
/// Where a picture's camera looks, which way is up in it, and how wide it sees.

namespace vantage {

/// Unit up vector for looking along −direction: the model's up axis projected to the picture.
/// Within 5° of straight up or down it turns towards a fixed horizontal axis: looking straight down
/// the model's back is at the top of the picture, looking straight up its front is. It changes
/// smoothly except, inside those 5°, for views that come from exactly behind: no field of up
/// vectors around a pole can be smooth everywhere. The model's front is +z, or −y if up is ±z.
/// \param direction unit vector to the eye. \param model_up unit axis.
Vec3 upright(const Vec3& direction, const Vec3& model_up);

/// A camera at `eye` that shows all `points`, as large as fits, none clipped.
/// Keeps the eye; shifts the target so that the points are centred both ways, and tightens the field
/// of view until they touch the margin on two opposite sides. Up is upright() of the direction from
/// `centre` to the eye, made orthogonal to the shifted line of sight. The target lies at the depth
/// of `centre`. Orthographic: the eye is put on the line of sight, in front of all points.
/// \param points at least one, finite. \param centre what the eye was placed around; not the eye.
/// \param model_up unit axis. \param aspect width over height, > 0.
/// \param margin empty border as a fraction of the shorter side, in [0, 0.5).
/// \throw InvalidInput if an argument is out of range, or if the eye is so near or inside that the
///        points cannot all lie in front of it.
Camera frame_points(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                    const Vec3& model_up, double aspect, double margin = 0.04);

}  // namespace vantage
