// SPDX-License-Identifier: MIT
#include "visibility/polygon_rest.h"

#include <array>
#include <utility>

namespace vantage {

double twice_area(Polygons::Points polygon) {
  double sum = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  return sum;
}

void PolygonRest::reset() {
  parts_.shrink_to(0);
  parts_.add(
      std::array{Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)});
}

void PolygonRest::subtract(Polygons::Points polygon) {
  next_.shrink_to(0);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::size_t before = next_.size();
    inside_.assign(parts_[i].begin(), parts_[i].end());
    for (std::size_t k = 0; k < polygon.size() && inside_.size() > 2; ++k) {
      const Eigen::Vector2d& from = polygon[k];
      const Eigen::Vector2d way = polygon[(k + 1) % polygon.size()] - from;
      outside_.clear();
      cut_polygon(
          inside_, [&](const Eigen::Vector2d& place) { return cross(way, place - from); }, kept_,
          [&](const Eigen::Vector2d& place) { outside_.push_back(place); });
      std::swap(inside_, kept_);
      if (twice_area(outside_) > kNoArea) {
        next_.add(outside_);
      }
    }
    if (!(twice_area(inside_) > kNoArea)) {
      next_.shrink_to(before);
      next_.add(parts_[i]);  // whole: the polygon passes it by
    }
  }
  std::swap(parts_, next_);
}

}  // namespace vantage
