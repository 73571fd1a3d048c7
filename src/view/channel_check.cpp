// SPDX-License-Identifier: MIT
#include "view/channel_check.h"

#include <cmath>

#include "vantage/core/error.h"

namespace vantage {

void check_channel(const ViewChannel& channel) {
  for (const auto& view : channel.views) {
    for (std::size_t i = 0; i < view.size(); ++i) {
      const bool ascends = i == 0 || view[i - 1].face < view[i].face;
      if (!ascends || view[i].face >= channel.face_count || !(view[i].area > 0.0F) ||
          !std::isfinite(view[i].area)) {
        throw InvalidInput(
            "a channel's views must list existing faces in ascending order with areas above 0");
      }
    }
  }
}

}  // namespace vantage
