// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/io/model.h"
#include "vantage/pipeline/find_views.h"

/// \file
/// The answer as JSON and CSV.

namespace vantage {

/// view.json: the same bytes for the same input, options and version.
/// \param seconds adds the times, for `--json`; null for the file.
std::string view_json(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
                      const ViewOptions& options, const StageSeconds* seconds = nullptr);

/// timings.json: the stage seconds alone.
std::string timings_json(const StageSeconds& seconds);

/// The search's evaluated directions as CSV: goal,step,level,dx,dy,dz,score.
std::string trace_csv(const ViewReport& report);

}  // namespace vantage
