// SPDX-License-Identifier: MIT
#include "spatial/point_cells.h"

#include <algorithm>
#include <cmath>

namespace vantage {

namespace {

constexpr double kMostCells = 64.0;  // along an axis
// Of rounding, so that what is exactly as far as the radius is looked at too.
constexpr double kMargin = 1e-9;

}  // namespace

PointCells::PointCells(std::span<const Vec3> points, double radius)
    : low_(points.front()), squared_radius_(radius * radius) {
  Vec3 high = low_;
  for (const Vec3& p : points) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 extent = high - low_;
  reach_ = Vec3::Constant(radius + kMargin * (radius + extent.maxCoeff()));
  side_ = std::max(radius, extent.maxCoeff() / kMostCells);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts_[axis] = static_cast<std::size_t>(extent[static_cast<Eigen::Index>(axis)] / side_) + 1;
  }
  sort_by_cells(points);
}

void PointCells::sort_by_cells(std::span<const Vec3> points) {
  std::vector<std::uint32_t> cells;
  cells.reserve(points.size());
  begin_.assign(counts_[0] * counts_[1] * counts_[2] + 1, 0);
  for (const Vec3& p : points) {
    cells.push_back(static_cast<std::uint32_t>(number_of(cell_of(p))));
    ++begin_[cells.back() + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) {
    begin_[c] += begin_[c - 1];
  }
  points_.resize(points.size());
  std::vector<std::uint32_t> next = begin_;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points_[next[cells[i]]++] = points[i];
  }
}

bool PointCells::has_near(const Vec3& place) const {
  const Cell first = cell_of(place - reach_);
  const Cell last = cell_of(place + reach_);
  for (std::size_t z = first[2]; z <= last[2]; ++z) {
    for (std::size_t y = first[1]; y <= last[1]; ++y) {
      const std::size_t end = begin_[number_of({last[0], y, z}) + 1];
      for (std::size_t i = begin_[number_of({first[0], y, z})]; i < end; ++i) {
        if ((points_[i] - place).squaredNorm() <= squared_radius_) {
          return true;
        }
      }
    }
  }
  return false;
}

PointCells::Cell PointCells::cell_of(const Vec3& place) const {
  Cell cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double most = static_cast<double>(counts_[axis] - 1);
    cell[axis] =
        static_cast<std::size_t>(std::clamp(std::floor((place[i] - low_[i]) / side_), 0.0, most));
  }
  return cell;
}

std::size_t PointCells::number_of(const Cell& cell) const {
  return (cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0];
}

}  // namespace vantage
