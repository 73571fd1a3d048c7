// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/channel.h"

namespace vantage {

/// \throw InvalidInput unless each view lists existing faces in ascending order with finite areas
/// above 0.
void check_channel(const ViewChannel& channel);

}  // namespace vantage
