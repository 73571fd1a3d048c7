// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include "vantage/core/camera.h"
#include "vantage/core/error.h"

namespace vantage {

/// Columns are the camera's x (right), y (up) and z, which is against its line of sight; all unit.
/// \throw InvalidInput if it looks along its up, or at its own eye
inline Eigen::Matrix3d camera_axes(const Camera& camera) {
  const Vec3 back = camera.eye - camera.target;
  const Vec3 right = camera.up.cross(back);
  if (!camera.eye.allFinite() || !(back.norm() > 0.0) || !(right.norm() > 0.0) ||
      !back.allFinite() || !right.allFinite()) {
    throw InvalidInput("a camera must look from one finite point at another, and not along its up");
  }
  Eigen::Matrix3d axes;
  axes.col(0) = right.normalized();
  axes.col(2) = back.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace vantage
