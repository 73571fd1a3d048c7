// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"

/// \file
/// A look at an answer before it is given: docs/conventions.md says what is looked at.

namespace vantage {

/// Why the answer should not be trusted, and what to do, one sentence each; empty almost always.
/// \param report with both views described.
/// \param agreement of checked_map_agreement(). \throw Cancelled
std::vector<std::string> reliability_warnings(const ShapeAnalysis& shape, const ViewReport& report,
                                              const ViewOptions& options, double agreement,
                                              const RunContext& run);

/// How well the ranks of the map's values agree with those on a copy of the surface whose vertices
/// are moved by 1e-4 of its diameter (Spearman), of the proxy where there is one; 1 where the map is
/// flat. \pre shape.views \throw Cancelled
double map_agreement_when_moved(const ShapeAnalysis& shape, const ViewOptions& options,
                                const RunContext& run);

/// The same where something happened on the way to the map that may be the mesh's doing, else 1: about
/// the time of an analysis, or none. Needs nothing of the views. \throw Cancelled
double checked_map_agreement(const ShapeAnalysis& shape, const ViewOptions& options,
                             const RunContext& run);

}  // namespace vantage
