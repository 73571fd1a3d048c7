// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/view/channel.h"

#include "core/shannon.h"

namespace vantage {

/// Entropy in bits of those faces of a view that were not seen before; their shares are of all that the view
/// sees (Vázquez et al. 2003). \param seen sum of the view's areas, > 0. \param dropped 1 for each face
/// that was seen.
inline double entropy_of_new(const std::vector<FaceArea>& view, double seen,
                             const std::vector<std::uint8_t>& dropped) {
  double sum = 0.0;
  for (const FaceArea& a : view) {
    sum -= dropped[a.face] == 0 ? x_log_x(static_cast<double>(a.area) / seen) : 0.0;
  }
  return sum;
}

}  // namespace vantage
