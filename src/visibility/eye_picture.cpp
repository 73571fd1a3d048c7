// SPDX-License-Identifier: MIT
// Where points, faces and blocks of faces are in the picture, and its cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "visibility/eye_grid.h"

namespace vantage {
namespace {

// The grid is used when the nearest site has at least this share of the farthest one's depth; a
// closer eye makes pictures too wide for a flat grid. [ours]
constexpr float kNearestShare = 1.0F / 64.0F;
// Points per cell, and the longest side of the grid in cells: 16 MB of counters at most. Both
// chosen by measurement on models of 10 K to 170 K vertices. [ours]
constexpr double kPointsPerCell = 1.0;
constexpr std::uint32_t kMaxCells = 2048;
// A float coordinate of a UnitFrame (below 1 in size) projected to an axis is wrong by less than
// this: twelve roundings of 2^-24.
constexpr float kAxisError = 0x1p-20F;
constexpr std::size_t kGrain = 4096;  // points per chunk: some tenths of a millisecond
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

bool EyeGrid::set_axes() {
  const double distance = eye_.position.norm();
  if (!(distance > 0.0) || !(distance < 1e6)) {
    return false;
  }
  const Vec3 towards = eye_.position / distance;  // from the frame's origin to the eye
  const Vec3 right = towards.unitOrthogonal();
  const Vec3 up = towards.cross(right);
  for (int i = 0; i < 3; ++i) {
    right_[i] = static_cast<float>(right[i]);
    up_[i] = static_cast<float>(up[i]);
    towards_[i] = static_cast<float>(towards[i]);
  }
  distance_ = static_cast<float>(distance);
  return true;
}

bool EyeGrid::aim(const Surface& surface, const RunContext& run) {
  if (surface.faces.empty() || !set_axes()) {
    return false;
  }
  project(surface.rounded, corners_, run);
  if (eye_.projection == Projection::Perspective) {
    float nearest = kInfinity;
    float farthest = -kInfinity;
    for (const Spot& s : corners_) {
      nearest = std::min(nearest, s.depth);
      farthest = std::max(farthest, s.depth);
    }
    return nearest + distance_ > kNearestShare * (farthest + distance_);
  }
  return true;
}

void EyeGrid::project(const FloatPoints& points, std::vector<Spot>& spots,
                      const RunContext& run) const {
  spots.resize(points.x.size());
  const bool perspective = eye_.projection == Projection::Perspective;
  const float shift = perspective ? distance_ : 0.0F;
  const float slope = perspective ? 1.0F : 0.0F;
  parallel_for(run, spots.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float x = points.x[i];
      const float y = points.y[i];
      const float z = points.z[i];
      const float depth = -(x * towards_[0] + y * towards_[1] + z * towards_[2]);
      const float shrink = 1.0F / (slope * (depth + shift) + (1.0F - slope));
      spots[i] = {(x * right_[0] + y * right_[1] + z * right_[2]) * shrink,
                  (x * up_[0] + y * up_[1] + z * up_[2]) * shrink, depth};
    }
  });
}

void EyeGrid::choose_cells(const std::vector<Spot>& corners, std::size_t active) {
  float x_high = -kInfinity;
  float y_high = -kInfinity;
  x_low_ = kInfinity;
  y_low_ = kInfinity;
  float nearest = kInfinity;
  for (const Spot& s : corners) {
    x_low_ = std::min(x_low_, s.x);
    x_high = std::max(x_high, s.x);
    y_low_ = std::min(y_low_, s.y);
    y_high = std::max(y_high, s.y);
    nearest = std::min(nearest, s.depth);
  }
  const float width = x_high - x_low_;
  const float height = y_high - y_low_;
  const double wanted = std::max(1.0, static_cast<double>(active) / kPointsPerCell);
  const double longest = std::max({width, height, 0x1p-20F});
  const double area = std::max(static_cast<double>(width) * height, longest * longest / wanted);
  const double limit = static_cast<double>(kMaxCells - 1) / longest;
  cells_per_unit_ = static_cast<float>(std::min(limit, std::sqrt(wanted / area)));
  columns_ = static_cast<std::uint32_t>(width * cells_per_unit_) + 1;
  rows_ = static_cast<std::uint32_t>(height * cells_per_unit_) + 1;

  float error = kAxisError;  // of x and y in the picture
  if (eye_.projection == Projection::Perspective) {
    const float closest = nearest + distance_;
    const float widest =
        std::max({std::abs(x_low_), std::abs(x_high), std::abs(y_low_), std::abs(y_high)});
    const float depth_error = kAxisError + 0x1p-23F * (distance_ + 2.0F);
    error = 2.0F * (kAxisError + widest * depth_error) / closest + 0x1p-22F * widest;
  }
  margin_ = error * cells_per_unit_ + 0x1p-22F * static_cast<float>(std::max(columns_, rows_));
}

void EyeGrid::to_cells(std::vector<Spot>& spots, const RunContext& run) const {
  parallel_for(run, spots.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      spots[i].x = (spots[i].x - x_low_) * cells_per_unit_;
      spots[i].y = (spots[i].y - y_low_) * cells_per_unit_;
    }
  });
}

EyeGrid::Outline EyeGrid::outline(const Triangle& face) const {
  const Spot& a = corners_[face[0]];
  const Spot& b = corners_[face[1]];
  const Spot& c = corners_[face[2]];
  const float reach = 2.0F * margin_;  // the face's error and the point's
  return {a,
          b,
          c,
          std::min({a.x, b.x, c.x}) - reach,
          std::max({a.x, b.x, c.x}) + reach,
          std::min({a.y, b.y, c.y}) - reach,
          std::max({a.y, b.y, c.y}) + reach,
          std::min({a.depth, b.depth, c.depth}) - 2.0F * kAxisError,
          std::max({a.depth, b.depth, c.depth}) + 2.0F * kAxisError};
}

void EyeGrid::outline_blocks(const FaceBlocks& blocks, const RunContext& run) {
  project(blocks.centres, centres_, run);
  blocks_.resize(centres_.size());
  const bool perspective = eye_.projection == Projection::Perspective;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Spot& spot = centres_[i];
    const float radius = blocks.radius[i] + kAxisError;
    // A place in the picture is x over the distance along the axis; both are within the radius.
    const float distance = perspective ? spot.depth + distance_ : 1.0F;
    const float near = perspective ? distance - radius : 1.0F;
    const float far = perspective ? distance + radius : 1.0F;
    const auto extent = [&](float place, float low, float scale) {
      const float left = place * distance - radius;
      const float right = place * distance + radius;
      const float reach = 2.0F * margin_ + 0x1p-20F * scale;
      return std::array{(left / (left < 0.0F ? near : far) - low) * scale - reach,
                        (right / (right < 0.0F ? far : near) - low) * scale + reach};
    };
    const auto [x_low, x_high] = extent(spot.x, x_low_, cells_per_unit_);
    const auto [y_low, y_high] = extent(spot.y, y_low_, cells_per_unit_);
    const bool whole = near > 0.0F;
    blocks_[i] = {{},
                  {},
                  {},
                  whole ? x_low : 0.0F,
                  whole ? x_high : static_cast<float>(columns_),
                  whole ? y_low : 0.0F,
                  whole ? y_high : static_cast<float>(rows_),
                  spot.depth - radius - 2.0F * kAxisError,
                  spot.depth + radius};
  }
}

}  // namespace vantage
