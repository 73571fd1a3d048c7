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

// Cells per side of a tile that knows its deepest point, as a shift. [ours, by measurement]
constexpr unsigned kTileShift = 2;
// Faces whose normal makes a larger cosine than this with the line of sight are steep: points
// clearly behind them (by 2^-21 of the frame) lie off their plane far more than a touch.
constexpr float kSteep = 0x1p-10F;
// A point's height over a face's plane, both of them rounded to float in a UnitFrame, is wrong by less
// than this: a dozen roundings of numbers below 1. It is also far more than a touch.
constexpr float kHeightError = 0x1p-19F;
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

/// Ready to tell which points may lie behind a face.
struct EyeGrid::Probe {
  std::array<std::array<float, 3>, 3> sides;  // x, y, 1: positive inside, length times distance
  float doubt;                                // error of these values
  float least;                                // points with less than this are outside
  std::array<std::uint32_t, 4> keys;          // of points that the face holds
};

void EyeGrid::begin(const Surface& surface, const Viewpoint& eye, const RunContext& run) {
  eye_ = eye;
  aim_ = Aim::None;
  face_sides(surface, run);
}

void EyeGrid::face_sides(const Surface& surface, const RunContext& run) {
  const Viewpoint& eye = eye_;
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

void EyeGrid::sort_points(const SurfacePoints& points, const std::vector<std::uint8_t>& seen) {
  const std::size_t sites = points.sites.size();
  const auto held_by = static_cast<std::uint32_t>(corners_.size());  // keys of faces begin here
  const auto cell_of = [&](const Spot& s) {
    return std::size_t{cell_at(s.y, rows_)} * columns_ + cell_at(s.x, columns_);
  };
  begin_.assign(std::size_t{rows_} * columns_ + 1, 0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] != 0) {
      ++begin_[cell_of(i < sites ? corners_[i] : spots_[i - sites])];
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
  for (std::size_t i = seen.size(); i-- > 0;) {
    if (seen[i] != 0) {
      const bool is_site = i < sites;
      const Spot& spot = is_site ? corners_[i] : spots_[i - sites];
      const std::uint32_t slot = --begin_[cell_of(spot)];
      point_of_[slot] = static_cast<std::uint32_t>(i);
      key_[slot] = is_site ? static_cast<std::uint32_t>(i) : held_by + points.owner[i - sites];
      x_[slot] = spot.x;
      y_[slot] = spot.y;
      depth_[slot] = spot.depth;
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
  return segment_to(points.place(point), eye_)
      .crosses(surface.sites[corners[0]], surface.sites[corners[1]], surface.sites[corners[2]],
               surface.twice_areas[face]);
}

EyeGrid::Probe EyeGrid::probe(std::uint32_t face, const Triangle& corners, const Outline& o) const {
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
  p.keys = {corners[0], corners[1], corners[2], static_cast<std::uint32_t>(corners_.size()) + face};
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
  out |= (key == p.keys[0]) | (key == p.keys[1]) | (key == p.keys[2]) | (key == p.keys[3]);
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

/// How far the point is behind the face's plane as the eye sees it; 0 for faces seen edge on.
float EyeGrid::depth_behind(const Surface& surface, const SurfacePoints& points,
                            std::uint32_t point, std::uint32_t face) const {
  const bool is_site = point < points.sites.size();
  const FloatPoints& places = is_site ? surface.rounded : *points.rounded;
  const std::size_t at = is_site ? point : point - points.sites.size();
  const FacePlanes& planes = surface.planes;
  const float height = planes.x[face] * places.x[at] + planes.y[face] * places.y[at] +
                       planes.z[face] * places.z[at] - planes.offset[face];
  return turned_[face] == 1 ? -height : turned_[face] == 2 ? height : 0.0F;
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
  bool is_hidden = inside > p.doubt && depth_[slot] > o.farthest && steep_[face] != 0;
  if (!is_hidden) {
    const std::uint32_t point = point_of_[slot];
    const float behind = depth_behind(surface, points, point, face);
    if (behind < -kHeightError) {
      return;  // on the eye's side
    }
    is_hidden = (behind > kHeightError && inside > p.doubt) || blocks(surface, points, point, face);
  }
  if (is_hidden) {
    hidden.store(1, std::memory_order_relaxed);
  }
}

std::size_t EyeGrid::strike(const Surface& surface, const SurfacePoints& points, std::uint32_t face,
                            const Outline& o) {
  const std::uint32_t left = cell_at(o.x_low, columns_);
  const std::uint32_t right = cell_at(o.x_high, columns_);
  const std::uint32_t bottom = cell_at(o.y_high, rows_);
  const Probe p = probe(face, surface.faces[face], o);
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
      if (f % FaceBlocks::kFaces == 0 && behind_all(blocks_[f / FaceBlocks::kFaces])) {
        f += FaceBlocks::kFaces - 1;
        continue;
      }
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

bool EyeGrid::hide(const Surface& surface, const SurfacePoints& points,
                   std::vector<std::uint8_t>& seen, const RunContext& run) {
  if (aim_ == Aim::None) {
    aim_ = aim(surface, run) ? Aim::Taken : Aim::Failed;
    if (aim_ == Aim::Taken) {
      choose_cells(corners_, static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1)));
      to_cells(corners_, run);
      outline_blocks(surface.blocks, run);
    }
  }
  if (aim_ == Aim::Failed) {
    return surface.faces.empty();
  }
  if (!points.exact.empty()) {
    project(*points.rounded, spots_, run);
    to_cells(spots_, run);
  }
  sort_points(points, seen);
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
