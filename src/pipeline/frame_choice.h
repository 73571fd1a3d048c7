// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/pipeline/find_views.h"

namespace vantage {

/// What a user should know of the front, a sentence; empty where it is a plain case.
/// \param eye from the centre towards the best view's eye; zero where nothing is to be said of its side.
std::string note_on_front(const FrameChoice& choice, const ViewOptions& options,
                          const Vec3& eye = Vec3::Zero());

}  // namespace vantage
