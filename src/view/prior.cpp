// SPDX-License-Identifier: MIT
#include "vantage/view/prior.h"

#include <cmath>

#include "core/unit_direction.h"

namespace vantage {

double ViewPrior::factor(const UprightFrame& frame, const Vec3& direction) const {
  if (is_uniform) {
    return 1.0;
  }
  const Vec3 to_eye = unit_direction(direction);
  const Vec3 local(frame.side.dot(to_eye), frame.up.dot(to_eye), frame.front.dot(to_eye));
  const double rise = local.y() - upright.elevation_sine;
  const double corner = 2.0 * local.x() * local.z();
  const double value = std::exp(-upright.elevation_strength * rise * rise -
                                upright.corner_strength * (1.0 - corner * corner) -
                                upright.front_strength * (1.0 - local.z()) -
                                upright.side_strength * (1.0 - local.x()));
  double favour = 1.0;
  for (const PriorLobe& lobe : lobes) {
    favour += lobe.weight *
              std::exp((lobe.direction.dot(local) - 1.0) / (lobe.width_rad * lobe.width_rad));
  }
  return value * favour;
}

ViewPrior no_prior() {
  return {};
}

ViewPrior upright_prior() {
  return {.name = "upright", .is_uniform = false};
}

}  // namespace vantage
