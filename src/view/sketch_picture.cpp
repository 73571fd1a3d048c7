// SPDX-License-Identifier: MIT
#include "view/sketch_picture.h"

#include <algorithm>
#include <array>
#include <limits>

namespace vantage {
namespace {

constexpr float kNothingThere = std::numeric_limits<float>::lowest();
// Corners farther outside count as so many cells away. [ours]
constexpr float kFarOutside = 1e6F;
// An eye this far behind a face's plane, as a share of one and its distance, does not see the front:
// far more than single precision rounds off.
constexpr float kClearlyBehind = 1e-5F;

// Cells are drawn in blocks of two rows of four, on every machine: a face hardly ever covers more
// columns than that.
constexpr std::int32_t kColumns = 4;
constexpr std::int32_t kRows = 2;
using Block = FloatsOf<8>;
using BlockInts = IntsOf<8>;

template <class Row, class Number>
VANTAGE_INLINE auto load_block(const Number* from, std::size_t row_length) {
  const auto first = load<Row>(from);
  const auto second = load<Row>(from + row_length);
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}

template <class Whole, class Number>
VANTAGE_INLINE void store_block(const Whole& block, Number* to, std::size_t row_length) {
  store(__builtin_shufflevector(block, block, 0, 1, 2, 3), to);
  store(__builtin_shufflevector(block, block, 4, 5, 6, 7), to + row_length);
}

template <class Planes, class Many>
VANTAGE_INLINE void keep(Planes& planes, const Many& along_x, const Many& along_y,
                         const Many& offset) {
  store(along_x, planes.along_x.data());
  store(along_y, planes.along_y.data());
  store(offset, planes.offset.data());
}

/// The first cells whose middles lie at a place or beyond; far to the left for what is no number.
template <unsigned Lanes>
VANTAGE_INLINE IntsOf<Lanes> cell_after(const FloatsOf<Lanes>& at) {
  constexpr float kCentre = 0.5F;  // of a cell
  const FloatsOf<Lanes> zero{};
  return __builtin_convertvector(
      smaller(larger(zero - kFarOutside, at), zero + kFarOutside) + kCentre, IntsOf<Lanes>);
}

}  // namespace

/// Some faces made ready to be drawn: of each the cells whose middles may lie inside and, as planes
/// over the picture, its nearness and its sides, which are positive inside.
template <unsigned Lanes>
struct SketchPicture::Outlines {
  struct Planes {
    std::array<float, Lanes> along_x, along_y, offset;
  };

  std::array<std::int32_t, Lanes> is_drawn, left, right, bottom, top;
  Planes nearness;
  std::array<Planes, 3> sides;
};

SketchPicture::SketchPicture(const SketchSurface& surface, std::size_t cells)
    : surface_(surface),
      cells_(cells),
      nearness_((cells + 1) * cells + kColumns, kNothingThere),
      face_at_(nearness_.size(), 0),
      planes_(surface.face_count) {}

void SketchPicture::draw(const SketchFrame& frame) {
  std::fill(nearness_.begin(), nearness_.end(), kNothingThere);
#if defined(__x86_64__)
  if (has_wide_registers()) {
    draw_faces_wide(frame);
    return;
  }
#endif
  draw_faces<4>(frame);
}

template <unsigned Lanes>
VANTAGE_INLINE void SketchPicture::draw_faces(const SketchFrame& frame) {
  using Many = FloatsOf<Lanes>;
  const float behind = -kClearlyBehind * (1.0F + frame.distance);
  Outlines<Lanes> outlines;
  for (std::size_t first = 0; first < surface_.face_count; first += Lanes) {
    const Many height = rise_along<Many>(surface_.planes.axis, first, frame.eye) -
                        frame.slope * load<Many>(surface_.planes.offset.data() + first);
    const auto may_show = height > behind;
    if (!any_of(may_show)) {
      continue;
    }
    outline<Lanes>(first, frame, may_show, outlines);
    for (unsigned lane = 0; lane < Lanes; ++lane) {
      if (outlines.is_drawn[lane] != 0) {
        draw_face<Lanes>(first + lane, outlines, lane);
      }
    }
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void SketchPicture::draw_faces_wide(const SketchFrame& frame) {
  draw_faces<kWideLanes>(frame);
}
#endif

/// Makes faces ready. Those that pad the list have no area and so are not drawn. Each face is judged
/// by itself, so that it does not matter how many are looked at side by side.
template <unsigned Lanes>
VANTAGE_INLINE void SketchPicture::outline(std::size_t first, const SketchFrame& frame,
                                           const IntsOf<Lanes>& may_show,
                                           Outlines<Lanes>& outlines) const {
  using Many = FloatsOf<Lanes>;
  std::array<SketchSpots<Many>, 3> corner;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    corner[k] = project<Many>(frame, surface_.corners[k], first);
  }
  const auto& [a, b, c] = corner;
  const Many ux = b.x - a.x;
  const Many uy = b.y - a.y;
  const Many un = b.nearness - a.nearness;
  const Many vx = c.x - a.x;
  const Many vy = c.y - a.y;
  const Many vn = c.nearness - a.nearness;
  const Many area = ux * vy - uy * vx;
  const Many zero{};
  const auto left = cell_after<Lanes>(smaller(smaller(a.x, b.x), c.x));
  const auto right = cell_after<Lanes>(larger(larger(a.x, b.x), c.x) - 1.0F);
  const auto bottom = cell_after<Lanes>(smaller(smaller(a.y, b.y), c.y));
  const auto top = cell_after<Lanes>(larger(larger(a.y, b.y), c.y) - 1.0F);
  store(left, outlines.left.data());
  store(right, outlines.right.data());
  store(bottom, outlines.bottom.data());
  store(top, outlines.top.data());
  const Many inverse = 1.0F / area;
  const Many along_x = (un * vy - vn * uy) * inverse;
  const Many along_y = (vn * ux - un * vx) * inverse;
  keep(outlines.nearness, along_x, along_y, a.nearness - along_x * a.x - along_y * a.y);
  const Many sense = area < zero ? zero - 1.0F : zero + 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const SketchSpots<Many>& from = corner[k];
    const SketchSpots<Many>& to = corner[(k + 1) % 3];
    const Many across = sense * (from.y - to.y);
    const Many along = sense * (to.x - from.x);
    keep(outlines.sides[k], across, along, -(across * from.x + along * from.y));
  }
  const auto two_sided = load<IntsOf<Lanes>>(surface_.two_sided.data() + first);
  const auto last = static_cast<std::int32_t>(cells_) - 1;
  store(((area > zero) | ((area < zero) & two_sided)) & may_show & (left <= right) &
            (bottom <= top) & (left <= last) & (bottom <= last) & (right >= 0) & (top >= 0),
        outlines.is_drawn.data());
}

template <unsigned Lanes>
VANTAGE_INLINE void SketchPicture::draw_face(std::size_t face, const Outlines<Lanes>& outlines,
                                             unsigned lane) {
  const std::size_t row_length = cells_;
  const auto last = static_cast<std::int32_t>(row_length) - 1;
  const std::int32_t right = std::min(last, outlines.right[lane]);
  const std::int32_t top = std::min(last, outlines.top[lane]);
  const std::int32_t bottom = std::max(0, outlines.bottom[lane]);
  const auto& [near_x, near_y, near_0] = outlines.nearness;
  planes_[face] = {near_x[lane], near_y[lane], near_0[lane]};
  const BlockInts id = BlockInts{} + static_cast<std::int32_t>(face);
  const Block first_y =
      static_cast<float>(bottom) + Block{0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};
  for (std::int32_t column = std::max(0, outlines.left[lane]); column <= right;
       column += kColumns) {
    // What is beyond the last column or row lies outside the face, if the sphere encloses it; else it
    // may be drawn into the next row.
    const Block x =
        static_cast<float>(column) + Block{0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
    std::array<Block, 3> across;
    for (std::size_t k = 0; k < across.size(); ++k) {
      across[k] = outlines.sides[k].along_x[lane] * x + outlines.sides[k].offset[lane];
    }
    const Block near_across = near_x[lane] * x + near_0[lane];
    Block y = first_y;
    const std::size_t cell =
        static_cast<std::size_t>(bottom) * row_length + static_cast<std::size_t>(column);
    float* nearness = nearness_.data() + cell;
    std::int32_t* faces = face_at_.data() + cell;
    for (std::int32_t row = bottom; row <= top; row += kRows) {
      const Block near = near_across + near_y[lane] * y;
      const auto before = load_block<FloatsOf<4>>(nearness, row_length);
      BlockInts wins = near > before;
      for (std::size_t k = 0; k < across.size(); ++k) {
        wins &= across[k] + outlines.sides[k].along_y[lane] * y >= 0.0F;
      }
      store_block(wins ? near : before, nearness, row_length);
      store_block(wins ? id : load_block<IntsOf<4>>(faces, row_length), faces, row_length);
      y += static_cast<float>(kRows);
      nearness += kRows * row_length;
      faces += kRows * row_length;
    }
  }
}

}  // namespace vantage
