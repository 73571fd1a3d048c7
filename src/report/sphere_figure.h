// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/render/render.h"

namespace vantage {

/// A panel of figure 6: the model in the colours of a map, and around it a wireframe sphere that is
/// coloured and raised by the score from each direction, as options.weight has it.
/// \param shape with the map that is scored. \param shown |V| values ≥ 0 that colour it.
/// \param from direction to look from.
Image sphere_panel(const ShapeAnalysis& shape, std::span<const double> shown, const Vec3& from,
                   UpAxis up, const ViewOptions& options, const RenderOptions& look,
                   const RunContext& run);

}  // namespace vantage
