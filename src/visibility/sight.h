// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "spatial/ray_scene.h"
#include "visibility/eye_grid.h"
#include "visibility/surface.h"

/// \file
/// What every visibility query stands on: a prepared surface, working memory that queries share,
/// and the two ways to find the faces that hide a point.

namespace vantage {

/// Grids that queries borrow, so that their memory is reused; at most one per thread exists.
class GridPool {
 public:
  std::unique_ptr<EyeGrid> borrow();
  void give_back(std::unique_ptr<EyeGrid> grid);

 private:
  std::mutex mutex_{};
  std::vector<std::unique_ptr<EyeGrid>> grids_{};
};

/// Queries may run on many threads at once.
class Sight {
 public:
  explicit Sight(Surface prepared) : surface_(std::move(prepared)) {}

  [[nodiscard]] const Surface& surface() const { return surface_; }

  /// The surface's sites as points to ask about.
  [[nodiscard]] SurfacePoints sites() const { return {surface_.sites, &surface_.rounded, {}}; }

  /// 1 for each site that the eye (in the frame) sees.
  std::vector<std::uint8_t> seen_sites(const Viewpoint& eye, const RunContext& run);

  /// 1 for each point that the eye sees. \pre points.owner is there.
  std::vector<std::uint8_t> seen_points(const SurfacePoints& points, const Viewpoint& eye,
                                        const RunContext& run);

  /// Whether a face hides the point from the eye; asks the hierarchy in space, which is built when
  /// first needed. Whether a face at the point is turned to the eye is not asked.
  bool hidden(const SurfacePoints& points, std::uint32_t point, const Viewpoint& eye);

 private:
  void finish(EyeGrid& grid, const SurfacePoints& points, const Viewpoint& eye,
              std::vector<std::uint8_t>& seen, const RunContext& run);

  Surface surface_;
  GridPool grids_{};
  std::once_flag candidates_once_{};
  std::optional<CandidateScene> candidates_{};
};

}  // namespace vantage
