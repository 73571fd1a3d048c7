// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/image.h"
#include "vantage/report/comparison.h"

namespace vantage {

/// The paper's figure 6: around the model the wireframe of all views of the set, farther out and
/// warmer the better the view from there is by the method. \throw Cancelled
Image view_sphere_picture(const ShapeAnalysis& shape, const Comparison& comparison,
                          const ComparedMethod& method, UpAxis up, int width, int height,
                          const RunContext& run);

}  // namespace vantage
