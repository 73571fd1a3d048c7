// SPDX-License-Identifier: MIT
#include "visibility/eye_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "spatial/segment.h"
#include "visibility/face_packet.h"

namespace vantage {
namespace {

// Cells per side of a tile that knows its deepest point, as a shift. [ours, by measurement]
constexpr unsigned kTileShift = 2;
// A point's height over a face's plane, both of them rounded to float in a UnitFrame, is wrong by
// less than this: a dozen roundings of numbers below 1. It is also far more than a touch.
constexpr float kHeightError = 0x1p-19F;
// Point tests per point and face after which faces are sorted by depth, and after which a hierarchy
// in space is worth more: a test takes a nanosecond, a ray a microsecond and, where large faces lie
// in a heap, a hundred. Models of one skin take about ten. [ours]
constexpr std::size_t kPatience = 64;
constexpr std::size_t kMostPatience = 1024;
// The patience is spent evenly over the faces, but for this share of it.
constexpr std::size_t kAhead = 16;
// Faces of the first batch, the nearest to the eye; each later batch is kThenTimes times all before.
constexpr std::size_t kNearestFaces = 64;
constexpr std::size_t kThenTimes = 3;
constexpr std::size_t kGrain = 4096;  // faces or points per chunk: some tenths of a millisecond
// Points tested at a time: what vector registers hold, those of every machine and wide ones.
constexpr unsigned kLanes = 4;
constexpr unsigned kWideLanes = 8;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class Many, std::size_t Lanes>
VANTAGE_INLINE std::array<Many, 3> loaded(const std::array<std::array<float, Lanes>, 3>& from) {
  return {load<Many>(from[0].data()), load<Many>(from[1].data()), load<Many>(from[2].data())};
}

template <class Many>
VANTAGE_INLINE Many least_of(const std::array<Many, 3>& of) {
  const Many least = of[1] < of[0] ? of[1] : of[0];
  return of[2] < least ? of[2] : least;
}

template <class Many>
VANTAGE_INLINE Many most_of(const std::array<Many, 3>& of) {
  const Many most = of[0] < of[1] ? of[1] : of[0];
  return most < of[2] ? of[2] : most;
}

/// The cells that places lie in, counted along one axis.
template <unsigned Lanes>
VANTAGE_INLINE void keep_cells(const typename Registers<Lanes>::Floats& at, float last,
                               std::array<std::uint32_t, Lanes>& cells) {
  const typename Registers<Lanes>::Floats zero{};
  const typename Registers<Lanes>::Floats end = zero + last;
  const typename Registers<Lanes>::Floats inside = at < zero ? zero : at;
  keep(__builtin_convertvector(end < inside ? end : inside, typename Registers<Lanes>::Truths),
       cells);
}

}  // namespace

void EyeGrid::begin(const Viewpoint& eye, const TurnedFaces& turned,
                    std::span<const std::uint8_t> back_faces) {
  eye_ = eye;
  turned_ = &turned;
  back_faces_ = back_faces;
  aim_ = Aim::None;
}

/// Lists the samples asked about and where they are.
void EyeGrid::place_samples(const std::vector<std::uint8_t>& seen, const RunContext& run) {
  asked_.resize(seen.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    asked_[count] = static_cast<std::uint32_t>(i);
    count += seen[i] != 0 ? 1 : 0;
  }
  asked_.resize(count);
  cell_.resize(count);
  const std::vector<Place>& places = picture_.places();
  parallel_for(run, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Place& place = places[asked_[k]];
      const CellRange at = picture_.cells_of({place, place});
      cell_[k] = at.top * picture_.columns() + at.left;
    }
  });
}

void EyeGrid::sort_samples() {
  const std::vector<Place>& places = picture_.places();
  begin_.assign(std::size_t{picture_.rows()} * picture_.columns() + 1, 0);
  for (const std::uint32_t cell : cell_) {
    ++begin_[cell];
  }
  std::uint32_t total = 0;
  for (std::uint32_t& count : begin_) {
    total += count;
    count = total;  // for now the end of the cell: filling walks back to its begin
  }
  hidden_.assign(total, 0);
  for (std::vector<float>* field : {&x_, &y_, &depth_}) {
    field->resize(total + kWideLanes);  // so that the last cell can be read by whole lanes
  }
  sample_of_.resize(total + kWideLanes);
  for (std::size_t k = asked_.size(); k-- > 0;) {
    const std::uint32_t i = asked_[k];
    const std::uint32_t slot = --begin_[cell_[k]];
    sample_of_[slot] = i;
    x_[slot] = places[i][0];
    y_[slot] = places[i][1];
    depth_[slot] = places[i][2];
  }
}

void EyeGrid::find_deepest() {
  const std::uint32_t columns = picture_.columns();
  tile_columns_ = (columns >> kTileShift) + 1;
  tile_rows_ = (picture_.rows() >> kTileShift) + 1;
  deepest_.assign(std::size_t{tile_columns_} * tile_rows_, -kInfinity);
  for (std::uint32_t row = 0; row < picture_.rows(); ++row) {
    for (std::uint32_t tile = 0; tile < tile_columns_; ++tile) {
      const std::size_t first = std::size_t{row} * columns;
      const std::uint32_t low = std::min(tile << kTileShift, columns);
      const std::uint32_t high = std::min((tile + 1) << kTileShift, columns);
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

/// Puts what is nearest to the eye first.
void EyeGrid::sort_faces(const Surface& surface) {
  const std::vector<Place>& places = picture_.places();
  std::vector<float> nearest;
  nearest.reserve(surface.faces.size());
  for (const auto& [a, b, c] : surface.faces) {
    nearest.push_back(std::min({places[a][2], places[b][2], places[c][2]}));
  }
  order_.resize(nearest.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t f, std::uint32_t g) { return nearest[f] < nearest[g]; });
}

/// \return the number of samples left.
std::size_t EyeGrid::mark_hidden(std::vector<std::uint8_t>& seen) const {
  std::size_t left = hidden_.size();
  for (std::size_t slot = 0; slot < hidden_.size(); ++slot) {
    if (hidden_[slot] != 0) {
      seen[sample_of_[slot]] = 0;
      --left;
    }
  }
  return left;
}

VANTAGE_INLINE bool EyeGrid::behind_all(float nearest, const CellRange& cells) const {
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

bool EyeGrid::blocks(const Surface& surface, std::uint32_t sample, std::uint32_t face) const {
  const Triangle& corners = surface.faces[face];
  return segment_to(surface.samples[sample], eye_)
      .crosses(surface.samples[corners[0]], surface.samples[corners[1]],
               surface.samples[corners[2]], surface.twice_areas[face]);
}

/// Makes the faces that were put in ready.
template <unsigned Lanes>
VANTAGE_INLINE void EyeGrid::make_ready(const Surface& surface, FacePacket<Lanes>& h) const {
  using Many = typename Registers<Lanes>::Floats;
  const std::vector<Place>& places = picture_.places();
  std::array<std::array<float, Lanes>, 3> corner_x;
  std::array<std::array<float, Lanes>, 3> corner_y;
  std::array<std::array<float, Lanes>, 3> corner_depth;
  for (unsigned lane = 0; lane < Lanes; ++lane) {
    const Triangle& corners = surface.faces[h.face[std::min(lane, h.count - 1)]];
    for (std::size_t k = 0; k < 3; ++k) {
      const Place& place = places[corners[k]];
      corner_x[k][lane] = place[0];
      corner_y[k][lane] = place[1];
      corner_depth[k][lane] = place[2];
    }
  }
  const std::array<Many, 3> x = loaded<Many>(corner_x);
  const std::array<Many, 3> y = loaded<Many>(corner_y);
  const std::array<Many, 3> depth = loaded<Many>(corner_depth);
  // The face's error and the point's.
  const float reach = 2.0F * picture_.margin();
  const Many low_x = least_of(x) - reach;
  const Many high_x = most_of(x) + reach;
  const Many low_y = least_of(y) - reach;
  const Many high_y = most_of(y) + reach;
  keep(least_of(depth) - 2.0F * EyePicture::kAxisError, h.nearest);
  keep_cells<Lanes>(low_x, picture_.last()[0], h.left);
  keep_cells<Lanes>(high_x, picture_.last()[0], h.right);
  keep_cells<Lanes>(low_y, picture_.last()[1], h.top);
  keep_cells<Lanes>(high_y, picture_.last()[1], h.bottom);
  const Many area = (x[1] - x[0]) * (y[2] - y[1]) - (y[1] - y[0]) * (x[2] - x[1]);
  const Many zero{};
  const Many sense = area < zero ? zero - 1.0F : zero + 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Many along_x = sense * (y[k] - y[next]);
    const Many along_y = sense * (x[next] - x[k]);
    keep(along_x, h.sides[k].along_x);
    keep(along_y, h.sides[k].along_y);
    keep(-(along_x * x[k] + along_y * y[k]), h.sides[k].offset);
  }
  // Bounds the error of a side's value at a place: of the places, and of a dozen roundings of
  // products of the grid's and the outline's size, which the margin holds a share of.
  const Many width = high_x - low_x;
  const Many height = high_y - low_y;
  const Many error_bound = 16.0F * picture_.margin() * (width < height ? height : width);
  keep(error_bound, h.error_bound);
  // A face whose sense is uncertain is within two errors of a line, and so is what it hides.
  keep(sense * area > error_bound ? -error_bound : -4.0F * error_bound, h.least);
}

/// How far the sample is behind the face's plane as the eye sees it; 0 for faces seen edge on.
float EyeGrid::depth_behind(const Surface& surface, std::uint32_t sample,
                            std::uint32_t face) const {
  const FloatPoints& places = surface.rounded;
  const FacePlanes& planes = surface.planes;
  const float height = planes.x[face] * places.x[sample] + planes.y[face] * places.y[sample] +
                       planes.z[face] * places.z[sample] - planes.offset[face];
  const std::uint8_t side = turned_->of_face[face];
  return side == 1 ? -height : side == 2 ? height : 0.0F;
}

template <unsigned Lanes>
void EyeGrid::hide_sample(const Surface& surface, const FacePacket<Lanes>& h, unsigned lane,
                          std::size_t slot) {
  // Other threads may hide the same sample meanwhile; they can only agree.
  const std::atomic_ref<std::uint8_t> hidden(hidden_[slot]);
  if (hidden.load(std::memory_order_relaxed) != 0) {
    return;
  }
  const std::uint32_t face = h.face[lane];
  float inside = kInfinity;
  for (const auto& side : h.sides) {
    inside = std::min(
        inside, x_[slot] * side.along_x[lane] + y_[slot] * side.along_y[lane] + side.offset[lane]);
  }
  const std::uint32_t sample = sample_of_[slot];
  const float behind = depth_behind(surface, sample, face);
  if (behind < -kHeightError) {
    return;  // on the eye's side
  }
  if ((behind > kHeightError && inside > h.error_bound[lane]) || blocks(surface, sample, face)) {
    hidden.store(1, std::memory_order_relaxed);
  }
}

template <unsigned Lanes>
VANTAGE_INLINE std::size_t EyeGrid::hide_behind(const Surface& surface, const FacePacket<Lanes>& h,
                                                unsigned lane) {
  const CellRange cells = cells_of(h, lane);
  const std::uint32_t face = h.face[lane];
  const FaceTest<Lanes> test(h, lane, surface.faces[face]);
  const SampleColumns columns{x_.data(), y_.data(), depth_.data(), sample_of_.data()};
  std::size_t work = 1;
  for (std::uint32_t row = cells.top; row <= cells.bottom; ++row) {
    const std::size_t first = std::size_t{row} * picture_.columns();
    const std::uint32_t end = begin_[first + cells.right + 1];
    const std::uint32_t begin = begin_[first + cells.left];
    work += 1 + end - begin;
    for (std::uint32_t slot = begin; slot < end; slot += Lanes) {
      unsigned found = test.may_hide(columns, slot);
      if (end - slot < Lanes) {
        found &= (1U << (end - slot)) - 1U;
      }
      for (; found != 0; found &= found - 1) {
        hide_sample<Lanes>(surface, h, lane,
                           slot + static_cast<std::uint32_t>(std::countr_zero(found)));
      }
    }
  }
  return work;
}

/// Of some of the faces those of one side, or of both in the order of their depths where it is 0.
struct EyeGrid::Walk {
  Walk(const Surface& of, std::uint8_t which, std::size_t most,
       std::span<const std::uint8_t> only = {})
      : surface(of),
        side(which),
        asked(only),
        limit(most),
        limit_each(most / std::max<std::size_t>(1, of.faces.size()) + 1),
        ahead(of.faces.size() / kAhead + 1) {}

  /// Whether one of a block's faces is asked.
  [[nodiscard]] bool asks_any(std::size_t first, std::size_t last) const {
    return asked.empty() || std::memchr(asked.data() + first, 1, last - first) != nullptr;
  }

  /// Whether it is too much work for so many faces.
  [[nodiscard]] bool is_too_much(std::size_t work, std::size_t faces) const {
    return work >= limit_each * (faces + ahead) || spent.load(std::memory_order_relaxed) > limit;
  }

  const Surface& surface;
  std::uint8_t side;
  std::span<const std::uint8_t> asked;  // of each face: whether it is; none: all are
  std::size_t limit;                    // of work, for all faces
  std::size_t limit_each;               // for one
  std::size_t ahead;                    // faces whose work may be spent before they are reached
  std::atomic<std::size_t> spent{0};
};

template <unsigned Lanes>
VANTAGE_INLINE std::size_t EyeGrid::hide_behind_all(Walk& walk, FacePacket<Lanes>& h) {
  if (h.count == 0) {
    return 0;
  }
  make_ready<Lanes>(walk.surface, h);
  // Fronts have their own corners behind them, as far as boxes can tell.
  const bool holds_asked = walk.side == 1;
  std::size_t work = 0;
  for (unsigned lane = 0; lane < h.count; ++lane) {
    if (holds_asked || !behind_all(h.nearest[lane], cells_of(h, lane))) {
      work += hide_behind<Lanes>(walk.surface, h, lane);
    }
  }
  h.count = 0;
  return work;
}

/// \pre begin is where a block begins.
template <unsigned Lanes>
VANTAGE_INLINE void EyeGrid::walk_blocks(Walk& walk, std::size_t begin, std::size_t end) {
  FacePacket<Lanes> some;
  std::size_t work = 0;
  for (std::size_t first = begin; first < end; first += FaceBlocks::kFaces) {
    const std::size_t block = first / FaceBlocks::kFaces;
    const std::uint8_t all = turned_->of_block[block];
    const EyePicture::Extent& extent = picture_.extent_of(block);
    const std::size_t last = std::min(end, first + FaceBlocks::kFaces);
    if ((all != 0 && all != walk.side) || !walk.asks_any(first, last) ||
        behind_all(extent.low[2], picture_.cells_of(extent))) {
      continue;
    }
    for (std::size_t f = first; f < last; ++f) {
      if ((all == 0 && (turned_->of_face[f] == 2) != (walk.side == 2)) ||
          (!walk.asked.empty() && walk.asked[f] == 0)) {
        continue;
      }
      some.face[some.count++] = static_cast<std::uint32_t>(f);
      if (some.count == Lanes) {
        work += hide_behind_all<Lanes>(walk, some);
      }
    }
    if (walk.is_too_much(work, last - begin)) {
      work += walk.limit;
      break;
    }
  }
  work += hide_behind_all<Lanes>(walk, some);
  walk.spent.fetch_add(work, std::memory_order_relaxed);
}

template <unsigned Lanes>
VANTAGE_INLINE void EyeGrid::walk_order(Walk& walk, std::size_t begin, std::size_t end) {
  FacePacket<Lanes> some;
  std::size_t work = 0;
  for (std::size_t k = begin; k < end && work <= walk.limit; ++k) {
    const std::uint32_t f = order_[k];
    if (turned_->of_face[f] == 2 && !back_faces_.empty() && back_faces_[f] == 0) {
      continue;
    }
    some.face[some.count++] = f;
    if (some.count == Lanes) {
      work += hide_behind_all<Lanes>(walk, some);
    }
  }
  work += hide_behind_all<Lanes>(walk, some);
  walk.spent.fetch_add(work, std::memory_order_relaxed);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void EyeGrid::walk_wide(Walk& walk, std::size_t begin, std::size_t end) {
  walk.side == 0 ? walk_order<kWideLanes>(walk, begin, end)
                 : walk_blocks<kWideLanes>(walk, begin, end);
}
#endif

/// \return false if that was too much work.
bool EyeGrid::walk(Walk& walk, std::size_t first, std::size_t count, const RunContext& run) {
  parallel_for(run, count, kGrain, [&](std::size_t begin, std::size_t end) {
#if defined(__x86_64__)
    if (has_wide_registers()) {
      return walk_wide(walk, first + begin, first + end);
    }
#endif
    walk.side == 0 ? walk_order<kLanes>(walk, first + begin, first + end)
                   : walk_blocks<kLanes>(walk, first + begin, first + end);
  });
  return walk.spent.load() <= walk.limit;
}

/// Fronts first, and what is seen edge on: most of what is hidden lies behind one. The back faces then have
/// little left to do, or nothing: the eye is outside of every shell, because all samples are ahead of it
/// where cells were chosen. \return false if the patience was not enough.
bool EyeGrid::walk_sides(const Surface& surface, const RunContext& run) {
  const std::size_t count = surface.faces.size();
  const std::size_t limit = kPatience * (hidden_.size() + count);
  find_deepest();
  Walk fronts{surface, 1, limit};
  if (!walk(fronts, 0, count, run)) {
    return false;
  }
  if (!back_faces_.empty() &&
      std::find(back_faces_.begin(), back_faces_.end(), 1) == back_faces_.end()) {
    return true;
  }
  find_deepest();
  Walk back_faces{surface, 2, limit, back_faces_};
  return walk(back_faces, 0, count, run);
}

/// For large faces that lie in a heap: the nearest of them hide most points, and all others are soon
/// asked about the few that are left. \return false if even this patience was not enough.
bool EyeGrid::walk_sorted(const Surface& surface, std::vector<std::uint8_t>& seen,
                          const RunContext& run) {
  const std::size_t count = surface.faces.size();
  Walk both{surface, 0, kMostPatience * (hidden_.size() + count)};
  sort_faces(surface);
  std::size_t left = mark_hidden(seen);
  std::size_t laid_out = left;
  picture_.lay_out(left, surface.blocks.balls, run);
  std::size_t done = 0;
  for (std::size_t next = std::min(kNearestFaces, count); next > 0;
       next = std::min(kThenTimes * done, count - done)) {
    if (2 * left < laid_out) {
      laid_out = left;
      picture_.lay_out(left, surface.blocks.balls, run);
    }
    place_samples(seen, run);
    sort_samples();
    find_deepest();
    const bool complete = walk(both, done, next, run);
    left = mark_hidden(seen);
    if (!complete) {
      return false;
    }
    done += next;
  }
  return true;
}

bool EyeGrid::hide(const Surface& surface, std::vector<std::uint8_t>& seen, const RunContext& run) {
  if (aim_ == Aim::None) {
    const bool is_flat = picture_.aim(eye_of_rounded(surface, eye_), surface.rounded, run);
    aim_ = is_flat ? Aim::Taken : Aim::Failed;
    if (aim_ == Aim::Taken) {
      picture_.lay_out(static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1)),
                       surface.blocks.balls, run);
    }
  }
  if (aim_ == Aim::Failed) {
    return surface.faces.empty();
  }
  place_samples(seen, run);
  sort_samples();
  if (walk_sides(surface, run)) {
    mark_hidden(seen);
    return true;
  }
  return walk_sorted(surface, seen, run);
}

}  // namespace vantage
