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

/// The map of a copy of the surface whose vertices are moved by 1e-4 of its diameter, of the proxy
/// where there is one.
struct MovedMap {
  std::vector<double> significance{};  ///< At the surface's vertices; empty if it was not made.
  /// Of its ranks with those of the map (Spearman); 1 where the map is flat, or this was not made.
  double agreement = 1.0;

  /// Whether the two are so unlike that the map hangs on how the surface is cut into triangles.
  [[nodiscard]] bool is_unlike() const;
};

/// \throw Cancelled
MovedMap moved_map(const ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run);

/// The same where something happened on the way to the map that may be the mesh's doing: about the
/// time of an analysis, or none. Needs nothing of the views. \throw Cancelled
MovedMap checked_moved_map(const ShapeAnalysis& shape, const ViewOptions& options,
                           const RunContext& run);

/// What is_unlike() means to a user, a sentence without its end.
std::string unlike_map_text(const MovedMap& moved);

/// Adds what there is to say of a skeleton that is partly outside, where that hardly touches the views.
void note_a_skeleton_outside(const ShapeAnalysis& shape, std::vector<std::string>& notes);

/// Adds why a skeleton has more cycles than the surface has handles, where sheets that touch explain it.
void note_cycles_beyond_genus(const ShapeAnalysis& shape, std::vector<std::string>& notes);

/// Why the answer should not be trusted, and what to do, one sentence each; empty almost always.
/// \param report with both views described. \throw Cancelled
std::vector<std::string> reliability_warnings(const ShapeAnalysis& shape, const ViewReport& report,
                                              const ViewOptions& options, const MovedMap& moved,
                                              const RunContext& run);

}  // namespace vantage
