// SPDX-License-Identifier: MIT
#include "visibility/eye_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "core/wide_registers.h"
#include "visibility/segment.h"

namespace vantage {
namespace {

// Cells per side of a tile that knows its deepest point, as a shift. [ours, by measurement]
constexpr unsigned kTileShift = 2;
// Faces whose normal makes a larger cosine than this with the line of sight are steep: points
// clearly behind them (by 2^-21 of the frame) lie off their plane far more than a touch.
constexpr float kSteep = 0x1p-10F;
// A point's height over a face's plane, both of them rounded to float in a UnitFrame, is wrong by
// less than this: a dozen roundings of numbers below 1. It is also far more than a touch.
constexpr float kHeightError = 0x1p-19F;
// A face whose normal is this close to a right angle with the line of sight is seen edge on: the
// rounding of positions in a UnitFrame and of the dot product, in radians.
constexpr double kEdgeOn = 0x1p-46;
// Point tests per point and face that are worth more than a hierarchy in space. [ours]
constexpr std::size_t kPatience = 64;
constexpr std::size_t kGrain = 4096;  // faces or points per chunk: some tenths of a millisecond
// Points tested at a time: what vector registers hold, those of every machine and wide ones.
constexpr unsigned kLanes = 4;
constexpr unsigned kWideLanes = 8;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

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

/// Ready to tell which points may lie behind a face. Along a side x, y, 1 are worth what is
/// positive inside, its length times the distance; one lane a side.
struct EyeGrid::Probe {
  Spot along_x, along_y, offset;
  float doubt;                        // error of these values
  float least;                        // points with less than this are outside
  std::array<std::uint32_t, 4> keys;  // of points that the face holds
};

void EyeGrid::begin(const Surface& surface, const Viewpoint& eye,
                    std::span<const std::uint8_t> backs, const RunContext& run) {
  eye_ = eye;
  aim_ = Aim::None;
  backs_ = backs;
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

/// Lists the points asked about and where they are.
void EyeGrid::place_points(const SurfacePoints& points, const std::vector<std::uint8_t>& seen,
                           const RunContext& run) {
  asked_.resize(seen.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    asked_[count] = static_cast<std::uint32_t>(i);
    count += seen[i] != 0 ? 1 : 0;
  }
  asked_.resize(count);
  spots_.resize(count);
  cell_.resize(count);
  const std::size_t sites = points.sites.size();
  parallel_for(run, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = asked_[k];
      spots_[k] = i < sites ? corners_[i] : in_cells(in_picture(*points.rounded, i - sites));
      const CellRange at = cells_of({spots_[k], spots_[k]});
      cell_[k] = at.top * columns_ + at.left;
    }
  });
}

void EyeGrid::sort_points(const SurfacePoints& points) {
  const std::size_t sites = points.sites.size();
  const auto held_by = static_cast<std::uint32_t>(corners_.size());  // keys of faces begin here
  begin_.assign(std::size_t{rows_} * columns_ + 1, 0);
  for (const std::uint32_t cell : cell_) {
    ++begin_[cell];
  }
  std::uint32_t total = 0;
  for (std::uint32_t& count : begin_) {
    total += count;
    count = total;  // for now the end of the cell: filling walks back to its begin
  }
  point_of_.resize(total);
  hidden_.assign(total, 0);
  for (std::vector<float>* field : {&x_, &y_, &depth_}) {
    field->resize(total + kWideLanes);  // so that the last cell can be read by whole lanes
  }
  key_.resize(total + kWideLanes);
  for (std::size_t k = asked_.size(); k-- > 0;) {
    const std::uint32_t i = asked_[k];
    const std::uint32_t slot = --begin_[cell_[k]];
    point_of_[slot] = i;
    key_[slot] = i < sites ? i : held_by + points.owner[i - sites];
    x_[slot] = spots_[k][0];
    y_[slot] = spots_[k][1];
    depth_[slot] = spots_[k][2];
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

VANTAGE_INLINE bool EyeGrid::behind_all(const Extent& extent, const CellRange& cells) const {
  const float nearest = extent.low[2];
  const std::uint32_t right = cells.right >> kTileShift;
  const std::uint32_t bottom = cells.bottom >> kTileShift;
  for (std::uint32_t y = cells.top >> kTileShift; y <= bottom; ++y) {
    for (std::uint32_t x = cells.left >> kTileShift; x <= right; ++x) {
      if (nearest <= deepest_[std::size_t{y} * tile_columns_ + x]) {
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

VANTAGE_INLINE EyeGrid::Probe EyeGrid::probe(std::uint32_t face, const Triangle& corners,
                                             const Outline& o) const {
  Probe p;
  const float area = (o.b[0] - o.a[0]) * (o.c[1] - o.b[1]) - (o.b[1] - o.a[1]) * (o.c[0] - o.b[0]);
  const float sign = area < 0.0F ? -1.0F : 1.0F;
  const Spot x{o.a[0], o.b[0], o.c[0], 0.0F};
  const Spot y{o.a[1], o.b[1], o.c[1], 0.0F};
  const Spot x_next{o.b[0], o.c[0], o.a[0], 0.0F};
  const Spot y_next{o.b[1], o.c[1], o.a[1], 0.0F};
  p.along_x = sign * (y - y_next);
  p.along_y = sign * (x_next - x);
  p.offset = -(p.along_x * x + p.along_y * y);
  // Bounds the error of a side's value at a spot: of the spots, and of a dozen roundings of
  // products of the grid's and the outline's size, which margin_ holds a share of.
  const Spot size = o.extent.high - o.extent.low;
  p.doubt = 16.0F * margin_ * std::max(size[0], size[1]);
  // A face whose sense is in doubt excludes nothing in its cells.
  p.least = std::abs(area) > p.doubt ? -p.doubt : -kInfinity;
  p.keys = {corners[0], corners[1], corners[2], static_cast<std::uint32_t>(corners_.size()) + face};
  return p;
}

/// Bit i is set if the point in slot + i may lie behind the face.
template <unsigned Lanes>
VANTAGE_INLINE unsigned EyeGrid::near(const Outline& o, const Probe& p, std::size_t slot) const {
  using Floats = typename Registers<Lanes>::Floats;
  using Keys = typename Registers<Lanes>::Keys;
  Floats x;
  Floats y;
  Floats depth;
  Keys key;
  std::memcpy(&x, x_.data() + slot, sizeof x);
  std::memcpy(&y, y_.data() + slot, sizeof y);
  std::memcpy(&depth, depth_.data() + slot, sizeof depth);
  std::memcpy(&key, key_.data() + slot, sizeof key);
  typename Registers<Lanes>::Truths out = depth < o.extent.low[2];
  for (int side = 0; side < 3; ++side) {
    out |= x * p.along_x[side] + y * p.along_y[side] + p.offset[side] < p.least;
  }
  out |= (key == p.keys[0]) | (key == p.keys[1]) | (key == p.keys[2]) | (key == p.keys[3]);
  std::array<std::uint64_t, Lanes / 2> pairs{};
  std::memcpy(pairs.data(), &out, sizeof pairs);
  std::uint64_t all = pairs[0];
  for (const std::uint64_t pair : pairs) {
    all &= pair;
  }
  if (all == ~std::uint64_t{0}) {
    return 0;
  }
  unsigned found = 0;
  for (unsigned lane = 0; lane < Lanes; ++lane) {
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
  const Spot values = x_[slot] * p.along_x + y_[slot] * p.along_y + p.offset;
  const float inside = std::min({values[0], values[1], values[2]});
  bool is_hidden = inside > p.doubt && depth_[slot] > o.extent.high[2] && steep_[face] != 0;
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

template <unsigned Lanes>
VANTAGE_INLINE std::size_t EyeGrid::strike(const Surface& surface, const SurfacePoints& points,
                                           std::uint32_t face, const Outline& o,
                                           const CellRange& cells) {
  std::optional<Probe> p;  // in most rows there is nothing
  std::size_t work = 1;
  for (std::uint32_t row = cells.top; row <= cells.bottom; ++row) {
    const std::size_t first = std::size_t{row} * columns_;
    const std::uint32_t end = begin_[first + cells.right + 1];
    const std::uint32_t begin = begin_[first + cells.left];
    work += 1 + end - begin;
    if (begin < end && !p) {
      p = probe(face, surface.faces[face], o);
    }
    for (std::uint32_t slot = begin; slot < end; slot += Lanes) {
      unsigned found = near<Lanes>(o, *p, slot);
      if (end - slot < Lanes) {
        found &= (1U << (end - slot)) - 1U;
      }
      for (; found != 0; found &= found - 1) {
        strike_point(surface, points, face, o, *p,
                     slot + static_cast<std::uint32_t>(std::countr_zero(found)));
      }
    }
  }
  return work;
}

/// Of some of the faces those of one side.
struct EyeGrid::Walk {
  const Surface& surface;
  const SurfacePoints& points;
  std::uint8_t side;
  std::size_t limit;  // of work, for all faces
  std::atomic<std::size_t> spent{0};
};

template <unsigned Lanes>
VANTAGE_INLINE void EyeGrid::walk_some(Walk& walk, std::size_t begin, std::size_t end) {
  const Surface& surface = walk.surface;
  const std::uint8_t side = walk.side;
  // Fronts have their own corners behind them then, as far as boxes can tell.
  const bool holds_asked = side == 1 && !walk.points.sites.empty();
  std::size_t work = 0;
  for (std::size_t f = begin; f < end; ++f) {
    if (f % FaceBlocks::kFaces == 0) {
      const Extent& block = blocks_[f / FaceBlocks::kFaces];
      if (behind_all(block, cells_of(block))) {
        f += FaceBlocks::kFaces - 1;
        continue;
      }
    }
    if ((turned_[f] == 2) != (side == 2) || (side == 2 && !backs_.empty() && backs_[f] == 0)) {
      continue;
    }
    const Outline o = outline(surface.faces[f]);
    const CellRange cells = cells_of(o.extent);
    if (holds_asked || !behind_all(o.extent, cells)) {
      work += strike<Lanes>(surface, walk.points, static_cast<std::uint32_t>(f), o, cells);
    }
    if (work > walk.limit || walk.spent.load(std::memory_order_relaxed) > walk.limit) {
      break;
    }
  }
  walk.spent.fetch_add(work, std::memory_order_relaxed);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void EyeGrid::walk_wide(Walk& walk, std::size_t begin, std::size_t end) {
  walk_some<kWideLanes>(walk, begin, end);
}
#endif

bool EyeGrid::walk(const Surface& surface, const SurfacePoints& points, std::uint8_t side,
                   const RunContext& run) {
  Walk walk{surface, points, side, kPatience * (point_of_.size() + surface.faces.size())};
  parallel_for(run, surface.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
#if defined(__x86_64__)
    if (has_wide_registers()) {
      return walk_wide(walk, begin, end);
    }
#endif
    walk_some<kLanes>(walk, begin, end);
  });
  return walk.spent.load() <= walk.limit;
}

bool EyeGrid::hide(const Surface& surface, const SurfacePoints& points,
                   std::vector<std::uint8_t>& seen, const RunContext& run) {
  if (aim_ == Aim::None) {
    aim_ = aim(surface, run) ? Aim::Taken : Aim::Failed;
    if (aim_ == Aim::Taken) {
      choose_cells(static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1)));
      to_cells(corners_, run);
      outline_blocks(surface.blocks, run);
    }
  }
  if (aim_ == Aim::Failed) {
    return surface.faces.empty();
  }
  place_points(points, seen, run);
  sort_points(points);
  // Fronts first, and what is seen edge on: most of what is hidden lies behind one. The backs then
  // have little left to do, or nothing: the eye is outside of every shell, because all sites are
  // ahead of it where cells were chosen.
  find_deepest();
  bool complete = walk(surface, points, 1, run);
  if (complete && (backs_.empty() || std::find(backs_.begin(), backs_.end(), 1) != backs_.end())) {
    find_deepest();
    complete = walk(surface, points, 2, run);
  }
  for (std::size_t slot = 0; slot < point_of_.size(); ++slot) {
    if (hidden_[slot] != 0) {
      seen[point_of_[slot]] = 0;
    }
  }
  return complete;
}

}  // namespace vantage
