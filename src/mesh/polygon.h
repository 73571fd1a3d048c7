// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// What cutting the polygons of one model may cost, in steps of about ten nanoseconds. Each corner gives its
/// polygon some; what all polygons need beyond that comes out of one reserve, so that many hopeless
/// ones take no longer than one.
class PolygonWork {
 public:
  /// \param run must outlive this.
  explicit PolygonWork(const RunContext& run) : run_(run) {}

  /// Begins a polygon.
  void begin(std::size_t corners) { left_ = kStepsPerCorner * corners; }

  /// Takes steps. \throw Cancelled now and then, if a stop was requested
  void spend(std::size_t steps);

  /// Whether no steps are left for this polygon.
  [[nodiscard]] bool is_spent() const { return left_ == 0 && reserve_ == 0; }

 private:
  // Enough for any real polygon. [ours]
  static constexpr std::size_t kStepsPerCorner = 400;
  static constexpr std::size_t kReserve = 20'000'000;

  const RunContext& run_;
  std::size_t left_ = 0;  ///< Of the polygon's own.
  std::size_t reserve_ = kReserve;
  std::size_t unchecked_ = 0;  ///< Since the last look whether to stop.
};

/// Triangulates a simple polygon in space, convex or not, by ear clipping in its best-fit plane
/// (Newell's normal), or by halving where it is convex. Always yields n − 2 triangles for n ≥ 3
/// corners (also for degenerate or self-crossing input, where no triangulation is right), none for
/// fewer. Winding is kept.
///
/// \param corners   indices into `positions`, in order around the polygon.
/// \param positions all points.
/// \param work      shared by all polygons of a model.
/// \param triangles receives the triangles at its end.
/// \throw Cancelled
void triangulate_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                         PolygonWork& work, std::vector<Triangle>& triangles);

}  // namespace vantage
