// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/report/view_report.h"

/// \file
/// A view that is nearly the best, in a fraction of the time: for thumbnails.

namespace vantage {

/// Result of find_quick_view().
struct QuickView {
  Vec3 direction = Vec3::UnitZ();  ///< From the model's centre to the eye; unit.
  UpChoice up{};                   ///< The up axis that was used.
  Camera picture{};                ///< From the eye of the scoring camera, framed tightly.
  std::size_t vertices = 0;        ///< Of the surface that was contracted and looked at.
  std::size_t evaluations = 0;     ///< Directions scored.
};

/// The method of find_views() on a coarser copy of a large surface, whose vertices carry the
/// significance of all that were merged in them, and a search for the best view alone that skips
/// every direction whose prior rules it out. docs/thumbnails.md says how close it comes.
/// \param model what `shape` was prepared from. \param shape of prepare_surface(); history,
/// skeleton and map are not needed.
/// \param options search is not looked at. \throw InvalidInput, Cancelled
QuickView find_quick_view(const Model& model, const ShapeAnalysis& shape,
                          const ViewOptions& options, const RunContext& run = {});

}  // namespace vantage
