// SPDX-License-Identifier: MIT
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/core/camera.h"
#include "vantage/core/error.h"

#include "core/unit_direction.h"

namespace vantage {

UprightFrame upright_frame(const Vec3& up) {
  const Vec3 unit = unit_direction(up);
  Eigen::Index axis = 0;
  unit.cwiseAbs().maxCoeff(&axis);
  UprightFrame frame;
  frame.up = Vec3::Unit(axis) * (unit[axis] < 0.0 ? -1.0 : 1.0);
  frame.front = axis == 2 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  frame.side = frame.up.cross(frame.front);
  return frame;
}

UprightFrame upright_frame(const Vec3& up, const Vec3& front) {
  constexpr double kRightAngle = 1e-6;  // a sine: beyond what rounding or six digits leave
  const UprightFrame frame{Vec3::Zero(), unit_direction(up), unit_direction(front)};
  if (!(std::abs(frame.up.dot(frame.front)) <= kRightAngle)) {
    throw InvalidInput("the front of a model must be at right angles to its up");
  }
  return {frame.up.cross(frame.front), frame.up, frame.front};
}

}  // namespace vantage
