// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "view/climb.h"
#include "view/search_guides.h"

namespace vantage {

/// The last part of the global search: from the best places found, up the hills that they lie on.
/// \param tops best first, with their exact scores; not empty.
/// \param noise of scores between directions near each other, or of what estimates them; 0: unknown.
/// \return the best of all that was scored exactly on the way. \throw Cancelled
Candidate climb_hills(const Guides& guides, Goal goal, const std::vector<Candidate>& tops,
                      double noise, const RunContext& run);

}  // namespace vantage
