// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "contraction/component_contraction.h"

namespace vantage {

/// Adds what the components' contractions came to: their summaries, the mean of their shrinkage by
/// vertices at each level of the history, and warnings of steps that were not taken as defined (each
/// begins with "contraction") and of systems that could not be solved.
/// \pre history.levels are there.
void summarise(std::span<const ComponentHistory> parts, ContractionHistory& history);

}  // namespace vantage
