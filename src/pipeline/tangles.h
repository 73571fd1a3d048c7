// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/pipeline/shape_analysis.h"

namespace vantage {

/// What there is to say of a skeleton of more loops than its shape can have, a sentence; empty almost
/// always. Of surfaces it speaks where that is much of the area. \complexity O(|F| α(|F|))
std::string tangle_text(const ShapeAnalysis& shape);

}  // namespace vantage
