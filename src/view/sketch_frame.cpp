// SPDX-License-Identifier: MIT
#include "view/sketch_frame.h"

#include <cmath>

#include <Eigen/Geometry>

namespace vantage {
namespace {

// The eye is drawn from so many radii at least and, up to so many, in perspective: nearer, what is
// close to it would fill thousands of pictures, and farther, depths would round to one another. The
// range of --distance begins there, too; at the far end an eye is off the parallel by 0.06°. [ours]
constexpr double kNearestEye = 1.001;
constexpr double kFarthestEye = 1000.0;

double radii_to_eye(const ScoringCamera& camera) {
  return camera.distance() / (0.5 * camera.sphere.diameter);
}

}  // namespace

ScoringCamera drawable(ScoringCamera camera) {
  const double factor = radii_to_eye(camera);
  if (factor > kFarthestEye) {
    camera.projection = Projection::Orthographic;
  }
  if (factor < kNearestEye) {
    camera.distance_factor = kNearestEye;
  }
  return camera;
}

SketchFrame::SketchFrame(const Vec3& direction, const ScoringCamera& camera, std::size_t cells) {
  const Vec3 to_the_right = direction.unitOrthogonal();
  right = to_the_right.cast<float>();
  up = direction.cross(to_the_right).cast<float>();
  towards = direction.cast<float>();
  const double radii = radii_to_eye(camera);
  const bool perspective = camera.projection == Projection::Perspective;
  eye = (perspective ? Vec3(direction * radii) : direction).cast<float>();
  distance = static_cast<float>(radii);
  slope = perspective ? 1.0F : 0.0F;
  // The sphere fills the picture; in perspective its outline has the tangent 1 / √(d² − 1).
  const double reach = perspective ? 1.0 / std::sqrt(radii * radii - 1.0) : 1.0;
  middle = 0.5F * static_cast<float>(cells);
  per_cell = static_cast<float>(0.5 * static_cast<double>(cells) / reach);
}

}  // namespace vantage
