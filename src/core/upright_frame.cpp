// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>

#include "vantage/core/camera.h"

namespace vantage {

UprightFrame upright_frame(const Vec3& up) {
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  UprightFrame frame;
  frame.up = Vec3::Unit(axis) * (up[axis] < 0.0 ? -1.0 : 1.0);
  frame.front = axis == 2 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  frame.side = frame.up.cross(frame.front);
  return frame;
}

UprightFrame upright_frame(const Vec3& up, const Vec3& front) {
  return {up.cross(front), up, front};
}

}  // namespace vantage
