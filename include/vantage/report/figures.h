// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/report/view_report.h"

/// \file
/// The paper's figures for any model. docs/figures.md says what each shows.

namespace vantage {

/// A picture of several panels, on white.
struct Figure {
  std::string name{};  ///< File name without extension, e.g. "figure-1-contraction".
  Image image{};       ///< Panels of the options' size, each with a line of text below.
  std::string svg{};   ///< The same as lines, where lines matter; else empty.
};

/// Figures 1 to 8 of the paper; all but 8 from the best view's camera. 6, 7 and 8 show mesh saliency
/// beside KSSM, with a search of its own. If the report has several views, they are on a sheet.
/// Of a cloud of points 1 and 2 show the points as small solids, and 6, 7 and 8 KSSM alone: mesh
/// saliency is of a surface's curvature.
/// \param shape with history, skeleton and map (kssm). \throw Cancelled
/// \param look of the panels that show the surface; white where it has no background.
std::vector<Figure> paper_figures(const ShapeAnalysis& shape, const ViewReport& report,
                                  const ViewOptions& options, const RunContext& run = {},
                                  const PictureLook& look = {});

/// The views of a set in their order, each with what it sees and what it adds.
/// \param size of each picture in `options`. \param look white where it has no background.
/// \throw Cancelled
Image view_sheet(const ShapeAnalysis& shape, const ReportedViewSet& set, const ViewOptions& options,
                 const RunContext& run = {}, const PictureLook& look = {});

/// One row of Table 1: what each stage took.
struct StageTimes {
  std::string model{};       ///< Name.
  std::size_t vertices = 0;  ///< Of the welded surface.
  std::size_t faces = 0;     ///< Of the same.
  StageSeconds seconds{};    ///< `load`, `contract`, `skeleton`, `map` and `search` are shown.
};

/// Table 1 as CSV: model,vertices,faces,load_s,contract_s,skeleton_s,map_s,search_s,sum_s.
std::string times_csv(const std::vector<StageTimes>& rows);
/// The same as a Markdown table.
std::string times_markdown(const std::vector<StageTimes>& rows);

/// A line of text in the middle of a white strip; of one that is too long the middle is left out.
/// Letters beyond ASCII are shown as "?". \param width px, ≥ 1. \param height px, ≥ 1.
Image caption(std::string_view text, int width, int height);

/// The pictures side by side on white, a gap between them and around. \pre all are of one size.
/// \throw InvalidInput if they are not, or there are none.
Image side_by_side(const std::vector<Image>& panels);

}  // namespace vantage
