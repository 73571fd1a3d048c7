// SPDX-License-Identifier: MIT
#include "visibility/eye_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "visibility/segment.h"

namespace vantage {
namespace {

// The grid is used when the nearest site has at least this share of the farthest one's depth; a
// closer eye makes pictures too wide for a flat grid. [ours]
constexpr float kNearestShare = 1.0F / 64.0F;
// Points per cell, and the longest side of the grid in cells: 16 MB of counters at most. Both
// chosen by measurement on models of 10 K to 170 K vertices. [ours]
constexpr double kPointsPerCell = 1.0;
constexpr std::uint32_t kMaxCells = 2048;
// Cells per side of a tile that knows its deepest point, as a shift. [ours, by measurement]
constexpr unsigned kTileShift = 2;
// A float coordinate of a UnitFrame (below 1 in size) projected to an axis is wrong by less than
// this: twelve roundings of 2^-24.
constexpr float kAxisError = 0x1p-20F;
// Faces whose normal makes a larger cosine than this with the line of sight are steep: points
// clearly behind them (by 2^-21 of the frame) lie off their plane far more than a touch.
constexpr float kSteep = 0x1p-10F;
// A face whose normal is this close to a right angle with the line of sight is seen edge on: the
// rounding of positions in a UnitFrame and of the dot product, in radians.
constexpr double kEdgeOn = 0x1p-46;
// Point tests per point and face that are worth more than a hierarchy in space. [ours]
constexpr std::size_t kPatience = 64;
constexpr std::size_t kGrain = 4096;  // faces or points per chunk: some tenths of a millisecond
// Points tested at a time: what baseline vector units hold.
constexpr unsigned kLanes = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::uint32_t cell_at(float at, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(at, 0.0F, static_cast<float>(count - 1)));
}

/// Which side of the face is turned to the eye, in double: 1 front, 2 back, 0 edge on.
std::uint8_t exact_side(const Surface& surface, std::size_t f, const Viewpoint& eye) {
  const Vec3 sight = eye.projection == Projection::Perspective
                         ? Vec3(eye.position - surface.sites[surface.faces[f][0]])
                         : eye.position;
  const double height = surface.area_vectors[f].dot(sight);
  if (!(std::abs(height) > kEdgeOn * surface.twice_areas[f] * sight.norm())) {
    return 0;
  }
  return height > 0.0 ? 1 : 2;
}

}  // namespace

/// A face in the picture: corners, and its extent rounded outwards.
struct EyeGrid::Outline {
  Spot a, b, c;
  float x_low, x_high, y_low, y_high, nearest, farthest;
};

/// Ready to tell which points may lie behind a face.
struct EyeGrid::Probe {
  std::array<std::array<float, 3>, 3> sides;  // x, y, 1: positive inside, length times distance
  float doubt;                                // error of these values
  float least;                                // points with less than this are outside
  Triangle keys;                              // of points that the face holds
};

bool EyeGrid::aim(const Viewpoint& eye) {
  eye_ = eye;
  const double distance = eye.position.norm();
  if (!(distance > 0.0) || !(distance < 1e6)) {
    return false;
  }
  const Vec3 towards = eye.position / distance;  // from the frame's origin to the eye
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

void EyeGrid::face_sides(const Surface& surface, const Viewpoint& eye, const RunContext& run) {
  const FacePlanes& planes = surface.planes;
  const std::size_t count = surface.faces.size();
  turned_.resize(count);
  steep_.resize(count);
  const bool perspective = eye.projection == Projection::Perspective;
  const auto length = static_cast<float>(eye.position.norm());
  const Eigen::Vector3f at = eye.position.cast<float>();
  const float offset = perspective ? 1.0F : 0.0F;
  // Bounds the rounding of the float height below: a dozen roundings of numbers of this size.
  const float doubt = 0x1p-19F * (length + 2.0F);
  const float steep = kSteep * (length + 2.0F);
  parallel_for(run, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const float height = planes.x[f] * at.x() + planes.y[f] * at.y() + planes.z[f] * at.z() -
                           offset * planes.offset[f];
      const float size = std::abs(height);
      const int side = height > 0.0F ? 1 : 2;
      turned_[f] = static_cast<std::uint8_t>(size > doubt ? side : 3);
      steep_[f] = static_cast<std::uint8_t>(size > steep ? 1 : 0);
    }
    for (std::size_t f = begin; f < end; ++f) {
      if (turned_[f] == 3) {
        turned_[f] = exact_side(surface, f, eye);
      }
    }
  });
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

void EyeGrid::sort_points(const std::vector<Spot>& spots, std::span<const std::uint32_t> owner,
                          const std::vector<std::uint8_t>& seen) {
  const auto cell_of = [&](const Spot& s) {
    return std::size_t{cell_at(s.y, rows_)} * columns_ + cell_at(s.x, columns_);
  };
  begin_.assign(std::size_t{rows_} * columns_ + 1, 0);
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (seen[i] != 0) {
      ++begin_[cell_of(spots[i])];
    }
  }
  std::uint32_t total = 0;
  for (std::uint32_t& count : begin_) {
    total += count;
    count = total;  // for now the end of the cell: filling walks back to its begin
  }
  point_of_.resize(total);
  hidden_.assign(total, 0);
  for (std::vector<float>* field : {&x_, &y_, &depth_}) {
    field->resize(total + kLanes);  // so that the last cell can be read by whole lanes
  }
  key_.resize(total + kLanes);
  for (std::size_t i = spots.size(); i-- > 0;) {
    if (seen[i] != 0) {
      const std::uint32_t slot = --begin_[cell_of(spots[i])];
      point_of_[slot] = static_cast<std::uint32_t>(i);
      key_[slot] = owner.empty() ? static_cast<std::uint32_t>(i) : owner[i];
      x_[slot] = spots[i].x;
      y_[slot] = spots[i].y;
      depth_[slot] = spots[i].depth;
    }
  }
}

void EyeGrid::find_deepest() {
  tile_columns_ = (columns_ >> kTileShift) + 1;
  tile_rows_ = (rows_ >> kTileShift) + 1;
  deepest_.assign(std::size_t{tile_columns_} * tile_rows_, -kInfinity);
  for (std::uint32_t row = 0; row < rows_; ++row) {
    for (std::uint32_t tile = 0; tile < tile_columns_; ++tile) {
      const std::size_t first = std::size_t{row} * columns_;
      const std::uint32_t low = std::min(tile << kTileShift, columns_);
      const std::uint32_t high = std::min((tile + 1) << kTileShift, columns_);
      float& deepest = deepest_[std::size_t{row >> kTileShift} * tile_columns_ + tile];
      for (std::uint32_t i = begin_[first + low]; i < begin_[first + high]; ++i) {
        if (hidden_[i] != 0) {
          depth_[i] = -kInfinity;  // nearer than every face
        }
        deepest = std::max(deepest, depth_[i]);
      }
    }
  }
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

bool EyeGrid::behind_all(const Outline& o) const {
  const std::uint32_t x_low = cell_at(o.x_low, columns_) >> kTileShift;
  const std::uint32_t x_high = cell_at(o.x_high, columns_) >> kTileShift;
  const std::uint32_t y_low = cell_at(o.y_low, rows_) >> kTileShift;
  const std::uint32_t y_high = cell_at(o.y_high, rows_) >> kTileShift;
  for (std::uint32_t y = y_low; y <= y_high; ++y) {
    for (std::uint32_t x = x_low; x <= x_high; ++x) {
      if (o.nearest <= deepest_[std::size_t{y} * tile_columns_ + x]) {
        return false;
      }
    }
  }
  return true;
}

bool EyeGrid::blocks(const Surface& surface, const SurfacePoints& points, std::uint32_t point,
                     std::uint32_t face) const {
  const Triangle& corners = surface.faces[face];
  if (points.held(point, face, corners)) {
    return false;
  }
  return segment_to(points.exact[point], eye_)
      .crosses(surface.sites[corners[0]], surface.sites[corners[1]], surface.sites[corners[2]],
               surface.twice_areas[face]);
}

EyeGrid::Probe EyeGrid::probe(const SurfacePoints& points, std::uint32_t face,
                              const Triangle& corners, const Outline& o) const {
  Probe p;
  const float area = (o.b.x - o.a.x) * (o.c.y - o.b.y) - (o.b.y - o.a.y) * (o.c.x - o.b.x);
  const float sign = area < 0.0F ? -1.0F : 1.0F;
  const auto side = [sign](const Spot& from, const Spot& to) -> std::array<float, 3> {
    const float x = sign * (from.y - to.y);
    const float y = sign * (to.x - from.x);
    return {x, y, -(x * from.x + y * from.y)};
  };
  p.sides = {side(o.a, o.b), side(o.b, o.c), side(o.c, o.a)};
  // Bounds the error of a side's value at a spot: of the spots, and of a dozen roundings of
  // products of the grid's and the outline's size, which margin_ holds a share of.
  p.doubt = 16.0F * margin_ * std::max(o.x_high - o.x_low, o.y_high - o.y_low);
  // A face whose sense is in doubt excludes nothing in its cells.
  p.least = std::abs(area) > p.doubt ? -p.doubt : -kInfinity;
  p.keys = points.owner.empty() ? corners : Triangle{face, face, face};
  return p;
}

/// Bit i is set if the point in slot + i may lie behind the face.
inline unsigned EyeGrid::near(const Outline& o, const Probe& p, std::size_t slot) const {
  using Floats = float __attribute__((vector_size(4 * kLanes)));
  using Keys = std::uint32_t __attribute__((vector_size(4 * kLanes)));
  Floats x;
  Floats y;
  Floats depth;
  Keys key;
  std::memcpy(&x, x_.data() + slot, sizeof x);
  std::memcpy(&y, y_.data() + slot, sizeof y);
  std::memcpy(&depth, depth_.data() + slot, sizeof depth);
  std::memcpy(&key, key_.data() + slot, sizeof key);
  auto out = depth < o.nearest;
  for (const auto& [along_x, along_y, offset] : p.sides) {
    out |= x * along_x + y * along_y + offset < p.least;
  }
  out |= (key == p.keys[0]) | (key == p.keys[1]) | (key == p.keys[2]);
  std::array<std::uint64_t, kLanes / 2> halves{};
  std::memcpy(halves.data(), &out, sizeof halves);
  if ((halves[0] & halves[1]) == ~std::uint64_t{0}) {
    return 0;
  }
  unsigned found = 0;
  for (unsigned lane = 0; lane < kLanes; ++lane) {
    found |= out[lane] == 0 ? 1U << lane : 0U;
  }
  return found;
}

void EyeGrid::strike_point(const Surface& surface, const SurfacePoints& points, std::uint32_t face,
                           const Outline& o, const Probe& p, std::size_t slot) {
  // Other threads may strike out the same point meanwhile; they can only agree.
  const std::atomic_ref<std::uint8_t> hidden(hidden_[slot]);
  if (hidden.load(std::memory_order_relaxed) != 0) {
    return;
  }
  float inside = kInfinity;
  for (const auto& [along_x, along_y, offset] : p.sides) {
    inside = std::min(inside, x_[slot] * along_x + y_[slot] * along_y + offset);
  }
  const bool clear = inside > p.doubt && depth_[slot] > o.farthest && steep_[face] != 0;
  if (clear || blocks(surface, points, point_of_[slot], face)) {
    hidden.store(1, std::memory_order_relaxed);
  }
}

std::size_t EyeGrid::strike(const Surface& surface, const SurfacePoints& points, std::uint32_t face,
                            const Outline& o) {
  const std::uint32_t left = cell_at(o.x_low, columns_);
  const std::uint32_t right = cell_at(o.x_high, columns_);
  const std::uint32_t bottom = cell_at(o.y_high, rows_);
  const Probe p = probe(points, face, surface.faces[face], o);
  std::size_t work = 1;
  for (std::uint32_t row = cell_at(o.y_low, rows_); row <= bottom; ++row) {
    const std::size_t first = std::size_t{row} * columns_;
    const std::uint32_t end = begin_[first + right + 1];
    const std::uint32_t begin = begin_[first + left];
    work += 1 + end - begin;
    for (std::uint32_t slot = begin; slot < end; slot += kLanes) {
      unsigned found = near(o, p, slot);
      if (end - slot < kLanes) {
        found &= (1U << (end - slot)) - 1U;
      }
      for (; found != 0; found &= found - 1) {
        strike_point(surface, points, face, o, p,
                     slot + static_cast<std::uint32_t>(std::countr_zero(found)));
      }
    }
  }
  return work;
}

bool EyeGrid::walk(const Surface& surface, const SurfacePoints& points, std::uint8_t side,
                   const RunContext& run) {
  const std::size_t limit = kPatience * (point_of_.size() + surface.faces.size());
  std::atomic<std::size_t> spent{0};
  parallel_for(run, surface.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::size_t work = 0;
    for (std::size_t f = begin; f < end; ++f) {
      if ((turned_[f] == 1) != (side == 1)) {
        continue;
      }
      const Outline o = outline(surface.faces[f]);
      if (!behind_all(o)) {
        work += strike(surface, points, static_cast<std::uint32_t>(f), o);
      }
      if (work > limit || spent.load(std::memory_order_relaxed) > limit) {
        break;
      }
    }
    spent.fetch_add(work, std::memory_order_relaxed);
  });
  return spent.load() <= limit;
}

bool EyeGrid::hide(const Surface& surface, const Viewpoint& eye, const SurfacePoints& points,
                   std::vector<std::uint8_t>& seen, const RunContext& run) {
  if (surface.faces.empty() || !aim(eye)) {
    return surface.faces.empty();
  }
  project(surface.rounded, corners_, run);
  if (eye.projection == Projection::Perspective) {
    float nearest = kInfinity;
    float farthest = -kInfinity;
    for (const Spot& s : corners_) {
      nearest = std::min(nearest, s.depth);
      farthest = std::max(farthest, s.depth);
    }
    if (!(nearest + distance_ > kNearestShare * (farthest + distance_))) {
      return false;
    }
  }
  const auto active = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1));
  choose_cells(corners_, active);
  to_cells(corners_, run);
  if (!points.owner.empty()) {
    project(*points.rounded, spots_, run);
    to_cells(spots_, run);
  }
  sort_points(points.owner.empty() ? corners_ : spots_, points.owner, seen);
  // Fronts first: most of what is hidden lies behind one. The backs then have little left to do.
  bool complete = true;
  for (const std::uint8_t side : {std::uint8_t{1}, std::uint8_t{2}}) {
    find_deepest();
    complete = complete && walk(surface, points, side, run);
  }
  for (std::size_t slot = 0; slot < point_of_.size(); ++slot) {
    if (hidden_[slot] != 0) {
      seen[point_of_[slot]] = 0;
    }
  }
  return complete;
}

}  // namespace vantage
