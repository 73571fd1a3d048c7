// SPDX-License-Identifier: MIT
#include "visibility/eye_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace vantage {
namespace {

// The grid is used when the nearest site has at least this share of the farthest one's depth; a
// closer eye makes pictures too wide for a flat grid.
constexpr double kNearestShare = 1.0 / 64.0;
// The finest level has at most 2^11 × 2^11 cells, 16 MB of counters.
constexpr unsigned kMaxBits = 11;
// Finest cells per face, and how many cells beyond its first a face may span before it goes to a
// coarser level: both chosen by measurement on shapes of 10 K to 170 K vertices.
constexpr double kCellsPerFace = 1.0;
constexpr std::uint32_t kSpan = 2;
// Outlines grow by this share of the picture (and of the depth range): four units in the last
// place of a float, whose rounding they must cover.
constexpr float kMargin = 0x1p-21F;

}  // namespace

bool EyeGrid::project(const Surface& surface, const Viewpoint& eye) {
  const bool perspective = eye.projection == Projection::Perspective;
  const double distance = eye.position.norm();
  if (!(distance > 0.0)) {
    return false;
  }
  const Vec3 towards = eye.position / distance;  // from the frame's origin to the eye
  const Vec3 right = towards.unitOrthogonal();
  const Vec3 up = towards.cross(right);
  plane_.resize(surface.sites.size());
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (std::size_t v = 0; v < plane_.size(); ++v) {
    const Vec3& p = surface.sites[v];
    const double along = -p.dot(towards);
    const double depth = perspective ? distance + along : along;
    const double shrink = perspective ? 1.0 / depth : 1.0;
    plane_[v] = {p.dot(right) * shrink, p.dot(up) * shrink, depth};
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  return !perspective || nearest > kNearestShare * farthest;
}

void EyeGrid::choose_resolution(std::size_t face_count) {
  const double cells = kCellsPerFace * static_cast<double>(face_count);
  bits_ = 0;
  while (bits_ < kMaxBits && std::ldexp(1.0, 2 * static_cast<int>(bits_) + 2) <= cells) {
    ++bits_;
  }
  level_begin_.assign(1, 0);
  for (unsigned level = 0; level <= bits_; ++level) {
    level_begin_.push_back(level_begin_.back() + (std::size_t{1} << (2 * (bits_ - level))));
  }

  std::array<double, 3> low = plane_.front();
  std::array<double, 3> high = low;
  for (const auto& p : plane_) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  const double size = std::max(high[0] - low[0], high[1] - low[1]);
  const double range = high[2] - low[2];
  const double last = std::ldexp(1.0, static_cast<int>(bits_)) * (1.0 - 0x1p-20);
  const double to_cells = size > 0.0 ? last / size : 0.0;
  const double to_depth = range > 0.0 ? 1.0 / range : 0.0;
  spots_.resize(plane_.size());
  for (std::size_t v = 0; v < plane_.size(); ++v) {
    spots_[v] = {static_cast<float>((plane_[v][0] - low[0]) * to_cells),
                 static_cast<float>((plane_[v][1] - low[1]) * to_cells),
                 static_cast<float>((plane_[v][2] - low[2]) * to_depth)};
  }
}

EyeGrid::Outline EyeGrid::outline(const Triangle& face) const {
  const Spot& a = spots_[face[0]];
  const Spot& b = spots_[face[1]];
  const Spot& c = spots_[face[2]];
  const float margin = kMargin * static_cast<float>(1U << bits_);
  return {std::min({a.x, b.x, c.x}) - margin, std::max({a.x, b.x, c.x}) + margin,
          std::min({a.y, b.y, c.y}) - margin, std::max({a.y, b.y, c.y}) + margin,
          std::min({a.depth, b.depth, c.depth}) - kMargin};
}

EyeGrid::Cover EyeGrid::cover(const Outline& outline) const {
  const auto last = static_cast<float>((1U << bits_) - 1);
  const auto cell = [&](float at) {
    return static_cast<std::uint32_t>(std::clamp(at, 0.0F, last));
  };
  const std::uint32_t x_low = cell(outline.x_low);
  const std::uint32_t x_high = cell(outline.x_high);
  const std::uint32_t y_low = cell(outline.y_low);
  const std::uint32_t y_high = cell(outline.y_high);
  unsigned level = 0;
  while (std::max((x_high >> level) - (x_low >> level), (y_high >> level) - (y_low >> level)) >
         kSpan) {
    ++level;
  }
  return {static_cast<std::uint16_t>(x_low >> level), static_cast<std::uint16_t>(y_low >> level),
          static_cast<std::uint8_t>((x_high >> level) - (x_low >> level) + 1),
          static_cast<std::uint8_t>((y_high >> level) - (y_low >> level) + 1),
          static_cast<std::uint8_t>(level)};
}

void EyeGrid::count_cells(const Surface& surface) {
  cell_begin_.assign(level_begin_.back() + 1, 0);
  outlines_.resize(surface.faces.size());
  covers_.resize(surface.faces.size());
  used_levels_ = 0;
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    outlines_[f] = outline(surface.faces[f]);
    const Cover c = cover(outlines_[f]);
    covers_[f] = c;
    used_levels_ |= 1U << c.level;
    std::size_t row = level_begin_[c.level] + (std::size_t{c.y_low} << (bits_ - c.level)) + c.x_low;
    for (unsigned y = 0; y < c.rows; ++y, row += std::size_t{1} << (bits_ - c.level)) {
      for (unsigned x = 0; x < c.columns; ++x) {
        ++cell_begin_[row + x];
      }
    }
  }
  std::uint32_t total = 0;
  for (std::uint32_t& count : cell_begin_) {
    total += count;
    count = total;  // for now the end of the cell: filling walks back to its begin
  }
  faces_.resize(total);
}

void EyeGrid::fill_cells() {
  for (std::uint32_t f = static_cast<std::uint32_t>(covers_.size()); f-- > 0;) {
    const Cover c = covers_[f];
    std::size_t row = level_begin_[c.level] + (std::size_t{c.y_low} << (bits_ - c.level)) + c.x_low;
    for (unsigned y = 0; y < c.rows; ++y, row += std::size_t{1} << (bits_ - c.level)) {
      for (unsigned x = 0; x < c.columns; ++x) {
        faces_[--cell_begin_[row + x]] = f;
      }
    }
  }
}

bool EyeGrid::build(const Surface& surface, const Viewpoint& eye) {
  if (surface.faces.empty() || !project(surface, eye)) {
    return false;
  }
  choose_resolution(surface.faces.size());
  count_cells(surface);
  fill_cells();
  return true;
}

std::size_t EyeGrid::candidate_count(std::uint32_t site) const {
  const auto x = static_cast<std::uint32_t>(spots_[site].x);
  const auto y = static_cast<std::uint32_t>(spots_[site].y);
  std::size_t count = 0;
  for (std::uint32_t levels = used_levels_; levels != 0; levels &= levels - 1) {
    const std::size_t cell = cell_of(static_cast<unsigned>(std::countr_zero(levels)), x, y);
    count += cell_begin_[cell + 1] - cell_begin_[cell];
  }
  return count;
}

}  // namespace vantage
