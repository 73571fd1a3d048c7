// SPDX-License-Identifier: MIT
#include "spatial/eye_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/parallel.h"

namespace vantage {
namespace {

// A picture is flat when the nearest point has at least this share of the farthest one's depth; a
// closer eye makes it too wide. [ours]
constexpr float kNearestShare = 1.0F / 64.0F;
// Points per cell, and the longest side of the grid in cells: 16 MB of counters at most. Both
// chosen by measurement on models of 10 K to 170 K vertices. [ours]
constexpr double kPointsPerCell = 1.0;
constexpr std::uint32_t kMaxCells = 2048;
constexpr std::size_t kPlacesPerTask = 4096;  // some tenths of a millisecond

}  // namespace

bool EyePicture::set_axes() {
  const double distance = eye_.position.norm();
  if (!(distance > 0.0) || !(distance < 1e6)) {
    return false;
  }
  const Vec3 towards = eye_.position / distance;  // from the frame's origin to the eye
  const Vec3 right = towards.unitOrthogonal();
  const Vec3 up = towards.cross(right);
  const auto added = [&](Eigen::Index i) {
    return Place{static_cast<float>(right[i]), static_cast<float>(up[i]),
                 -static_cast<float>(towards[i]), 0.0F};
  };
  along_x_ = added(0);
  along_y_ = added(1);
  along_z_ = added(2);
  distance_ = static_cast<float>(distance);
  const bool perspective = eye_.projection == Projection::Perspective;
  shift_ = perspective ? distance_ : 0.0F;
  slope_ = perspective ? 1.0F : 0.0F;
  return true;
}

bool EyePicture::aim(const Viewpoint& eye, const FloatPoints& points, const RunContext& run) {
  eye_ = eye;
  if (points.x.empty() || !set_axes()) {
    return false;
  }
  project(points, projected_, run);
  spanned_ = {projected_.front(), projected_.front()};
  for (const Place& s : projected_) {
    spanned_ = {lower(spanned_.low, s), higher(spanned_.high, s)};
  }
  return eye_.projection == Projection::Orthographic ||
         spanned_.low[2] + distance_ > kNearestShare * (spanned_.high[2] + distance_);
}

void EyePicture::project(const FloatPoints& points, std::vector<Place>& places,
                         const RunContext& run) const {
  places.resize(points.x.size());
  parallel_for(run, places.size(), kPlacesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      places[i] = in_picture(points, i);
    }
  });
}

void EyePicture::lay_out(std::size_t count, const FloatBalls& balls, const RunContext& run) {
  choose_cells(count);
  places_.resize(projected_.size());
  parallel_for(run, places_.size(), kPlacesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      places_[i] = (projected_[i] - origin_) * scale_;
    }
  });
  span_balls(balls, run);
}

void EyePicture::choose_cells(std::size_t count) {
  const float width = spanned_.high[0] - spanned_.low[0];
  const float height = spanned_.high[1] - spanned_.low[1];
  const double wanted = std::max(1.0, static_cast<double>(count) / kPointsPerCell);
  const double longest = std::max({width, height, 0x1p-20F});
  const double area = std::max(static_cast<double>(width) * height, longest * longest / wanted);
  const double limit = static_cast<double>(kMaxCells - 1) / longest;
  cells_per_unit_ = static_cast<float>(std::min(limit, std::sqrt(wanted / area)));
  columns_ = static_cast<std::uint32_t>(width * cells_per_unit_) + 1;
  rows_ = static_cast<std::uint32_t>(height * cells_per_unit_) + 1;
  origin_ = Place{spanned_.low[0], spanned_.low[1], 0.0F, 0.0F};
  scale_ = Place{cells_per_unit_, cells_per_unit_, 1.0F, 0.0F};
  last_ = Place{static_cast<float>(columns_ - 1), static_cast<float>(rows_ - 1), 0.0F, 0.0F};

  float error = kAxisError;  // of x and y in the picture
  if (eye_.projection == Projection::Perspective) {
    const float closest = spanned_.low[2] + distance_;
    const float widest = std::max({std::abs(spanned_.low[0]), std::abs(spanned_.high[0]),
                                   std::abs(spanned_.low[1]), std::abs(spanned_.high[1])});
    const float depth_error = kAxisError + 0x1p-23F * (distance_ + 2.0F);
    error = 2.0F * (kAxisError + widest * depth_error) / closest + 0x1p-22F * widest;
  }
  margin_ = error * cells_per_unit_ + 0x1p-22F * static_cast<float>(std::max(columns_, rows_));
}

void EyePicture::span_balls(const FloatBalls& balls, const RunContext& run) {
  project(balls.centres, centres_, run);
  extents_.resize(centres_.size());
  const bool perspective = eye_.projection == Projection::Perspective;
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    const Place place = centres_[i];
    const float radius = balls.radius[i] + kAxisError;
    // A place in the picture is x over the distance along the axis; both are within the radius.
    const float distance = perspective ? place[2] + distance_ : 1.0F;
    const float near = perspective ? distance - radius : 1.0F;
    const float far = perspective ? distance + radius : 1.0F;
    const auto extent = [&](float at, float low, float scale) {
      const float left = at * distance - radius;
      const float right = at * distance + radius;
      const float reach = 2.0F * margin_ + 0x1p-20F * scale;
      return std::array{(left / (left < 0.0F ? near : far) - low) * scale - reach,
                        (right / (right < 0.0F ? far : near) - low) * scale + reach};
    };
    const auto [x_low, x_high] = extent(place[0], origin_[0], cells_per_unit_);
    const auto [y_low, y_high] = extent(place[1], origin_[1], cells_per_unit_);
    const bool whole = near > 0.0F;
    const float nearest = place[2] - radius - 2.0F * kAxisError;
    const float farthest = place[2] + radius;
    const auto columns = static_cast<float>(columns_);
    const auto rows = static_cast<float>(rows_);
    extents_[i] =
        whole ? Extent{Place{x_low, y_low, nearest, 0.0F}, Place{x_high, y_high, farthest, 0.0F}}
              : Extent{Place{0.0F, 0.0F, nearest, 0.0F}, Place{columns, rows, farthest, 0.0F}};
  }
}

}  // namespace vantage
