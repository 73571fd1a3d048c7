// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// Points in the cells of a grid, to be asked again and again whether one is near a place. Built in a
/// fraction of the time of a tree over them.
class PointCells {
 public:
  /// \param points finite, at least one. \param radius within which has_near() looks, > 0, units of the points.
  /// \complexity O(n), and 64³ cells at most.
  PointCells(std::span<const Vec3> points, double radius);

  /// Whether a point lies at most the radius away.
  [[nodiscard]] bool has_near(const Vec3& place) const;

 private:
  using Cell = std::array<std::size_t, 3>;

  void sort_by_cells(std::span<const Vec3> points);
  [[nodiscard]] Cell cell_of(const Vec3& place) const;
  [[nodiscard]] std::size_t number_of(const Cell& cell) const;

  Vec3 low_;
  double squared_radius_;
  Vec3 reach_{};  // to either side
  double side_ = 0.0;
  Cell counts_{};                       // of cells along each axis
  std::vector<std::uint32_t> begin_{};  // of each cell's points, and the end of the last
  std::vector<Vec3> points_{};          // by cells
};

}  // namespace vantage
