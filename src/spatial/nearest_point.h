// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "vantage/core/vec3.h"

#include "spatial/point_tree.h"

namespace vantage {

/// Finds the nearest of many points by a tree, and of points equally near always the same.
class NearestPoint {
 public:
  /// \param points at least one, finite.
  explicit NearestPoint(std::vector<Vec3> points);

  /// The index of the point nearest to a place, the lowest of those that are as near.
  [[nodiscard]] std::size_t to(const Vec3& place) const;

 private:
  std::vector<Vec3> points_;
  std::unique_ptr<const PointTree> tree_;  ///< Refers to the points: moves with them.
};

}  // namespace vantage
