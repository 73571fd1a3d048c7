// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/pipeline/view_options.h"

namespace vantage {

/// Adds what there is to say of scenes whose parts, the components of the surface, the views hardly
/// show: of half of them nothing that counts is seen from anywhere, or much of what is significant is
/// small beside the rest. \pre the map is there. \throw Cancelled
void note_parts_hardly_shown(const ShapeAnalysis& shape, const ViewOptions& options,
                             std::vector<std::string>& notes, const RunContext& run);

}  // namespace vantage
