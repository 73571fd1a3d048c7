// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/scoring.h"

#include "view/sketch_points.h"
#include "view/sketch_surface.h"

/// \file
/// Scores guessed from a small picture: some points stand for all vertices, a coarse surface hides
/// them in a depth buffer of a few thousand cells. What the global search looks the sphere over by:
/// an estimate takes some 30 microseconds whatever the size of the model.

namespace vantage {

/// How fine a sketch is. More is slower and, for the search, hardly better. [ours, docs/search.md]
struct SketchOptions {
  std::size_t points = 2500;  ///< That stand for all vertices.
  std::size_t faces = 2000;   ///< About so many hide them.
  std::size_t cells = 96;     ///< Of the picture, along each side.
  /// A point this far behind a face, in radii of the sphere, still counts as lying on it: what the
  /// coarse surface deviates by.
  float slack = 0.02F;
};

/// Those for the global search on a surface of so many vertices: below kCheapBelow they are finer.
SketchOptions sketch_options(std::size_t vertices);
/// A model of fewer vertices is searched more thoroughly: its scores are rough, and one costs less
/// than a millisecond. [ours, docs/search.md]
inline constexpr std::size_t kCheapBelow = 6000;

/// Immutable; answers do not depend on the number of threads.
class SketchScorer {
 public:
  /// \param sides one per component of `surface`.
  /// \param significance one finite value ≥ 0 per vertex.
  /// \param coarse sketch_surface() of them, for options.faces and the camera's sphere; null: it is
  /// made.
  SketchScorer(const TriMesh& surface, const std::vector<FaceSides>& sides,
               std::span<const double> significance, const ScoringCamera& camera,
               const SketchOptions& options = {},
               std::shared_ptr<const SketchSurface> coarse = nullptr);

  /// About the score of each direction, in parallel over directions. \throw Cancelled
  [[nodiscard]] std::vector<double> score_all(std::span<const Vec3> directions,
                                              const RunContext& run = {}) const;

 private:
  ScoringCamera camera_;
  std::size_t cells_;
  float slack_;
  std::shared_ptr<const SketchSurface> surface_;
  SketchPoints points_;
};

}  // namespace vantage
