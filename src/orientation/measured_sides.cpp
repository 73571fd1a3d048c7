// SPDX-License-Identifier: MIT
#include "orientation/measured_sides.h"

#include <algorithm>
#include <cmath>

namespace vantage {

MeasuredSides::MeasuredSides(const TriMesh& surface, const TextureFlow& texture_flow)
    : fields(surface), traits(surface), flow(texture_flow) {
  knows_origin = std::all_of(fields.origin.begin(), fields.origin.end(),
                             [](double share) { return std::abs(share - 0.5) <= kFar; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reliefs[2 * axis] = side_relief(fields, axis, true);
    reliefs[2 * axis + 1] = side_relief(fields, axis, false);
    mirror[axis] = mirror_error(fields, axis);
    half_turn[axis] = half_turn_error(fields, axis);
    quarter_turn[axis] = quarter_turn_error(fields, axis);
  }
}

double MeasuredSides::difference(AxisDirection up, AxisDirection front, AxisDirection other) const {
  if (front == other) {
    return 0.0;
  }
  // What looks the same after a quarter of a turn does so after two.
  return front.axis == other.axis ? std::min(half_turn[up.axis], mirror[front.axis])
                                  : std::max(quarter_turn[up.axis], half_turn[up.axis]);
}

}  // namespace vantage
