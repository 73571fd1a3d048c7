// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/report/pictures.h"

/// \file
/// report.html: one self-contained page to explore a result in. docs/report.md describes it,
/// viewer/README.md its data block.

namespace vantage {

/// Whether this build has the page: it is bundled by npm when the library is built.
bool has_report_page();

/// The page: the model in 3D with its significance, skeleton and contraction, the view sphere as a
/// heat map, the views with their cameras, the paper's search to replay. Models past 300 000 faces
/// are simplified for display, which the page says; the numbers are those of the whole model. The
/// scores on the sphere and in the replay are estimates, which meet the exact ones at the best and
/// the worst view.
/// \pre the map is there. \throw InvalidInput if !has_report_page(). \throw Cancelled
/// \complexity about a thousand estimates, then about 30 bytes a face.
std::string report_html(const Model& model, const ShapeAnalysis& shape, ShapePictures& pictures,
                        const ViewReport& report, const ViewOptions& options,
                        const RunContext& run = {});

/// view.json: the same bytes for the same input, options and version.
/// \param seconds adds the times, for `--json`; null for the file.
std::string view_json(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
                      const ViewOptions& options, const StageSeconds* seconds = nullptr);

/// timings.json: the stage seconds alone.
std::string timings_json(const StageSeconds& seconds);

/// The search's evaluated directions as CSV: goal,step,level,dx,dy,dz,score.
std::string trace_csv(const ViewReport& report);

}  // namespace vantage
