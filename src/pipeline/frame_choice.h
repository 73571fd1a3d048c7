// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/pipeline/find_views.h"

namespace vantage {

/// What a user should know of the front, a sentence; empty where it is a plain case.
/// \param is_behind whether the best view shows its back.
std::string note_on_front(const FrameChoice& choice, const ViewOptions& options,
                          bool is_behind = false);

}  // namespace vantage
