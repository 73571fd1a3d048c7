// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace vantage {

/// Half of the width and of the height that may be filled, in halves of the picture's height.
struct Room {
  double x;
  double y;
};

/// \param aspect width over height. \param margin of both sides, parts of the shorter side.
inline Room room_for(double aspect, double margin) {
  const double border = 2.0 * margin * std::min(aspect, 1.0);
  return {aspect - border, 1.0 - border};
}

}  // namespace vantage
