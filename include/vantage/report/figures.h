// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/report/view_report.h"

/// \file
/// The paper's figures for any model. docs/figures.md says what each shows.

namespace vantage {

/// A picture of several panels from left to right, on white.
struct Figure {
  std::string name{};  ///< File name without extension, e.g. "figure-1-contraction".
  Image image{};       ///< Panels of the options' size.
};

/// Figures 1, 2, 3, 5, 7 and 8 of the paper; all but 8 from the best view's camera.
/// \param shape of a surface, with history, skeleton and map.
/// \throw InvalidInput for a cloud of points, which has no surface to contract. \throw Cancelled
std::vector<Figure> paper_figures(const ShapeAnalysis& shape, const ViewReport& report,
                                  const ViewOptions& options, const RunContext& run = {});

/// The pictures side by side on white, a gap between them and around. \pre all are of one size.
/// \throw InvalidInput if they are not, or there are none.
Image side_by_side(const std::vector<Image>& panels);

}  // namespace vantage
