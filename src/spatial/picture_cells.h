// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// The picture of a surface divided into cells, to find faces and edges that lie before or behind
/// each other. It only proposes: everything is rounded outwards, and the geometry decides.

namespace vantage {

/// From a place to the eye, or towards it.
inline Vec3 sight_line(const Vec3& place, const Viewpoint& eye) {
  return eye.projection == Projection::Perspective ? Vec3(eye.position - place) : eye.position;
}

/// Projects the vertices of a surface on one plane where all of them are well ahead of the eye, else
/// on the six sides of a cube around it. Made for reuse.
class PictureCells {
 public:
  /// Cells of one side, from first to last.
  struct CellRange {
    std::uint16_t left = 0, right = 0, bottom = 0, top = 0;

    [[nodiscard]] std::size_t count() const {
      return static_cast<std::size_t>(right - left + 1) *
             static_cast<std::size_t>(top - bottom + 1);
    }
  };

  /// A place in the picture, in cells, and its depth.
  struct Place {
    float x = 0.0F, y = 0.0F, depth = 0.0F;
  };

  /// What something spans in the picture, in cells, and its depths.
  struct Extent {
    float left = 0.0F, right = 0.0F, bottom = 0.0F, top = 0.0F;
    float nearest = 0.0F, farthest = 0.0F;
    CellRange cells{};  ///< That it touches, if the picture is flat.
  };

  /// \param samples places of the surface's vertices, which must outlive the use of this.
  /// \param eye in their frame. \param cells about how many there shall be.
  void begin(std::span<const Vec3> samples, const Viewpoint& eye, std::size_t cells);

  /// Whether the picture is one plane.
  [[nodiscard]] bool is_flat() const { return is_flat_; }

  /// Whether all of the surface is ahead of the eye.
  [[nodiscard]] bool is_ahead() const { return is_ahead_; }

  /// Halves the number of rows and of columns. \return false if there is one of each.
  bool coarsen();

  [[nodiscard]] std::size_t cell_count() const { return std::size_t{columns_} * side_; }

  [[nodiscard]] std::uint32_t cell(std::uint32_t column, std::uint32_t row) const {
    return row * columns_ + column;
  }

  /// What a place on the surface spans: itself. \pre is_flat().
  [[nodiscard]] Extent extent_of(const Vec3& place) const {
    const Place at = in_cells(on_plane(place));
    const std::uint16_t column = nearest_cell(at.x);
    const std::uint16_t row = nearest_cell(at.y);
    return {at.x, at.x, at.y, at.y, at.depth, at.depth, {column, column, row, row}};
  }

  /// Of an edge's ends or of a face's corners.
  template <std::size_t Count>
  [[nodiscard]] Extent extent(const std::array<std::uint32_t, Count>& samples) const {
    constexpr float kAll = std::numeric_limits<float>::infinity();
    if (!is_flat_) {
      return {-kAll, kAll, -kAll, kAll, -kAll, kAll, {}};
    }
    const Place& first = places_[samples[0]];
    Extent extent{first.x, first.x, first.y, first.y, first.depth, first.depth, {}};
    for (std::size_t k = 1; k < Count; ++k) {
      const Place& place = places_[samples[k]];
      extent.left = std::min(extent.left, place.x);
      extent.right = std::max(extent.right, place.x);
      extent.bottom = std::min(extent.bottom, place.y);
      extent.top = std::max(extent.top, place.y);
      extent.nearest = std::min(extent.nearest, place.depth);
      extent.farthest = std::max(extent.farthest, place.depth);
    }
    extent.left -= kSlack;
    extent.right += kSlack;
    extent.bottom -= kSlack;
    extent.top += kSlack;
    extent.nearest -= kDepthSlack;
    extent.farthest += kDepthSlack;
    extent.cells = {nearest_cell(extent.left), nearest_cell(extent.right),
                    nearest_cell(extent.bottom), nearest_cell(extent.top)};
    return extent;
  }

  /// The sides of a face in the picture, to tell what lies beside it.
  class Outline {
   public:
    Outline(const PictureCells& picture, const Triangle& face);

    /// Whether an edge or a face clearly lies beyond one of the sides.
    template <std::size_t Count>
    [[nodiscard]] bool is_beside(const std::array<std::uint32_t, Count>& samples) const {
      if (!picture_.is_flat_) {
        return false;
      }
      for (const Line& line : lines_) {
        float most = -line.slack;
        for (const std::uint32_t sample : samples) {
          const Place& place = picture_.places_[sample];
          most = std::max(most, line.x * place.x + line.y * place.y - line.offset);
        }
        if (most <= -line.slack) {
          return true;
        }
      }
      return false;
    }

   private:
    /// Points inside have a positive x · place − offset; rounding moves it less than the slack.
    struct Line {
      float x = 0.0F, y = 0.0F, offset = 0.0F, slack = 0.0F;
    };

    const PictureCells& picture_;
    std::array<Line, 3> lines_{};
  };

  /// Calls each(cells) for the cells that an edge or a face touches: of one side, or of several; row
  /// by row where it lies across many, lest what is long and slanted be in all cells around it.
  template <std::size_t Count, typename Each>
  void over_sides(const std::array<std::uint32_t, Count>& samples, const Extent& extent,
                  const Each& each) const {
    if (is_flat_) {
      if (extent.cells.count() <= kFewCells || extent.cells.left == extent.cells.right) {
        each(extent.cells);
        return;
      }
      for (std::uint32_t row = extent.cells.bottom; row <= extent.cells.top; ++row) {
        each(cells_in_row(places_, samples, extent.cells, static_cast<std::uint16_t>(row)));
      }
      return;
    }
    std::array<Vec3, Count> from_eye;
    for (std::size_t k = 0; k < Count; ++k) {
      from_eye[k] = samples_[samples[k]] - eye_.position;
    }
    for (std::uint32_t side = 0; side < kSides; ++side) {
      CellRange cells;
      if (on_side(from_eye.data(), Count, side, cells)) {
        each(cells);
      }
    }
  }

  /// How many cells an edge or a face touches.
  template <std::size_t Count>
  [[nodiscard]] std::size_t count_cells(const std::array<std::uint32_t, Count>& samples,
                                        const Extent& extent) const {
    std::size_t sum = 0;
    over_sides(samples, extent, [&](const CellRange& cells) { sum += cells.count(); });
    return sum;
  }

  /// Calls each(cell) for the cells that an edge or a face touches.
  template <std::size_t Count, typename Each>
  void over_cells(const std::array<std::uint32_t, Count>& samples, const Extent& extent,
                  const Each& each) const {
    over_sides(samples, extent, [&](const CellRange& cells) {
      for (std::uint32_t row = cells.bottom; row <= cells.top; ++row) {
        for (std::uint32_t column = cells.left; column <= cells.right; ++column) {
          each(cell(column, row));
        }
      }
    });
  }

 private:
  static constexpr std::uint32_t kSides = 6;
  static constexpr std::uint32_t kMostSide = 1024;  // cells
  // Far more than rounding to float moves a place, in cells, and a depth, in units of the frame.
  static constexpr float kSlack = 1e-3F;
  static constexpr float kDepthSlack = 1e-5F;
  static constexpr std::size_t kFewCells = 16;  // which are not told apart by rows

  /// Those of a row that something convex with these corners touches, of the cells of its extent.
  template <std::size_t Count>
  [[nodiscard]] CellRange cells_in_row(const std::vector<Place>& places,
                                       const std::array<std::uint32_t, Count>& samples,
                                       const CellRange& all, std::uint16_t row) const {
    // Beyond the first and the last row there are only places that rounding moved out of the picture.
    constexpr float kAll = std::numeric_limits<float>::infinity();
    const float low = row == 0 ? -kAll : static_cast<float>(row) - kSlack;
    const float high = row + 1U == side_ ? kAll : static_cast<float>(row + 1) + kSlack;
    float left = kAll;
    float right = -kAll;
    for (std::size_t k = 0; k < Count; ++k) {
      const Place& from = places[samples[k]];
      const Place& to = places[samples[(k + 1) % Count]];
      const auto [lower, upper] = std::minmax(from.y, to.y);
      if (upper < low || lower > high) {
        continue;
      }
      // The side runs straight from where it enters the row to where it leaves it.
      for (const float y : {std::max(low, lower), std::min(high, upper)}) {
        const float share = to.y == from.y ? 0.0F : (y - from.y) / (to.y - from.y);
        const float x = from.x + share * (to.x - from.x);
        left = std::min(left, x);
        right = std::max(right, x);
      }
      if (to.y == from.y) {
        left = std::min(left, to.x);
        right = std::max(right, to.x);
      }
    }
    return {std::clamp(nearest_cell(left - kSlack), all.left, all.right),
            std::clamp(nearest_cell(right + kSlack), all.left, all.right), row, row};
  }

  [[nodiscard]] std::uint16_t nearest_cell(float place) const {
    return static_cast<std::uint16_t>(std::clamp(place, 0.0F, static_cast<float>(side_ - 1)));
  }

  void project();

  /// Where a place is on the plane of the picture, and its depth along the view axis.
  [[nodiscard]] Vec3 on_plane(const Vec3& place) const {
    const double along = place.dot(towards_);
    const double depth = eye_.projection == Projection::Perspective ? distance_ - along : 1.0;
    return {place.dot(right_) / depth, place.dot(up_) / depth, -along};
  }

  [[nodiscard]] Place in_cells(const Vec3& on_plane) const {
    return {static_cast<float>((on_plane.x() - low_.x()) * per_unit_.x()),
            static_cast<float>((on_plane.y() - low_.y()) * per_unit_.y()),
            static_cast<float>(on_plane.z())};
  }

  [[nodiscard]] bool on_side(const Vec3* from_eye, std::size_t count, std::uint32_t side,
                             CellRange& cells) const;

  std::span<const Vec3> samples_{};
  Viewpoint eye_{};
  bool is_flat_ = true;
  bool is_ahead_ = true;
  double distance_ = 0.0;  // of the eye from the frame's origin
  Vec3 towards_ = Vec3::UnitZ(), right_ = Vec3::UnitX(), up_ = Vec3::UnitY();  // the picture's axes
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();       // corner of the picture, on its plane
  Eigen::Vector2d per_unit_ = Eigen::Vector2d::Zero();  // cells
  std::uint32_t side_ = 1;                              // cells along a side
  std::uint32_t columns_ = 1;                           // of all sides together
  std::vector<Place> places_{};                         // of each sample, where there is one plane
  std::vector<Vec3> exact_{};                           // the same in double, not yet in cells
};

}  // namespace vantage
