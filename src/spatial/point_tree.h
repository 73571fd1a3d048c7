// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include "vantage/core/vec3.h"

namespace vantage {

/// Points as nanoflann wants to see them, and the tree over them. The points must outlive it.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3> points)
      : view_{points}, tree_(3, view_, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}

  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Fills `found` with the nearest points, ascending by distance; returns how many there are.
  std::size_t nearest(const Vec3& place, std::span<std::size_t> found,
                      std::span<double> squared) const {
    return tree_.knnSearch(place.data(), found.size(), found.data(), squared.data());
  }

  using Match = std::pair<std::size_t, double>;

  /// All points nearer than `radius`, in no particular order.
  void within(const Vec3& place, double radius, std::vector<Match>& found) const {
    nanoflann::SearchParams unsorted;
    unsorted.sorted = false;
    tree_.radiusSearch(place.data(), radius * radius, found, unsorted);
  }

 private:
  // nanoflann calls these members by these names.
  struct View {
    std::span<const Vec3> points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }

    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i][static_cast<Eigen::Index>(axis)];
    }

    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
      return false;
    }
  };

  View view_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, View>, View, 3,
                                      std::size_t>
      tree_;
};

}  // namespace vantage
