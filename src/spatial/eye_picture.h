// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "core/wide_registers.h"

// Functions that take or give wide registers are inlined, all of them: nobody else calls them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage {

/// Points rounded to float, coordinate by coordinate, for loops that the compiler vectorises.
struct FloatPoints {
  std::vector<float> x{}, y{}, z{};
};

struct FloatBalls {
  FloatPoints centres{};
  std::vector<float> radius{};  ///< Rounded up.
};

/// Where points and balls of a UnitFrame are in the picture of one eye, in single precision, and the
/// cells of that picture. Made for reuse: another eye allocates nothing new.
class EyePicture {
 public:
  /// A float coordinate of a UnitFrame (below 1 in size) projected to an axis is wrong by less than
  /// this: twelve roundings of 2^-24.
  static constexpr float kAxisError = 0x1p-20F;

  /// A place in the picture: x, y in cells, depth along the view axis in frame units; the fourth is
  /// 0.
  using Place = float __attribute__((vector_size(4 * sizeof(float))));

  /// What something spans in the picture, rounded outwards: its least x, y and depth, and its
  /// largest.
  struct Extent {
    Place low, high;
  };

  /// The cells that an extent touches: columns and rows, from first to last.
  struct CellRange {
    std::uint32_t left, right, top, bottom;
  };

  /// Looks at points from an eye in their frame.
  /// \return false if the eye is too near for a flat picture, or there are no points.
  bool aim(const Viewpoint& eye, const FloatPoints& points, const RunContext& run);

  /// Chooses cells, one for each of so many points, and puts points and balls into them; any number
  /// of times. \pre aim() has returned true.
  void lay_out(std::size_t count, const FloatBalls& balls, const RunContext& run);

  /// Of each point.
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }

  /// Of a ball.
  [[nodiscard]] const Extent& extent_of(std::size_t ball) const { return extents_[ball]; }

  [[nodiscard]] std::uint32_t columns() const { return columns_; }

  [[nodiscard]] std::uint32_t rows() const { return rows_; }

  /// The last column and the last row.
  [[nodiscard]] const Place& last() const { return last_; }

  /// Bound of the error of a place's x and y, in cells.
  [[nodiscard]] float margin() const { return margin_; }

  [[nodiscard]] VANTAGE_INLINE CellRange cells_of(const Extent& extent) const {
    const Cells low = __builtin_convertvector(lower(higher(extent.low, Place{}), last_), Cells);
    const Cells high = __builtin_convertvector(lower(higher(extent.high, Place{}), last_), Cells);
    return {static_cast<std::uint32_t>(low[0]), static_cast<std::uint32_t>(high[0]),
            static_cast<std::uint32_t>(low[1]), static_cast<std::uint32_t>(high[1])};
  }

 private:
  using Cells = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));

  bool set_axes();
  void project(const FloatPoints& points, std::vector<Place>& places, const RunContext& run) const;
  void choose_cells(std::size_t count);
  void span_balls(const FloatBalls& balls, const RunContext& run);

  VANTAGE_INLINE static Place lower(const Place& a, const Place& b) { return b < a ? b : a; }

  VANTAGE_INLINE static Place higher(const Place& a, const Place& b) { return a < b ? b : a; }

  [[nodiscard]] Place in_picture(const FloatPoints& points, std::size_t at) const {
    const Place place = points.x[at] * along_x_ + points.y[at] * along_y_ + points.z[at] * along_z_;
    const float shrink = 1.0F / (slope_ * (place[2] + shift_) + (1.0F - slope_));
    return place * Place{shrink, shrink, 1.0F, 0.0F};
  }

  Viewpoint eye_{};
  Place along_x_{}, along_y_{}, along_z_{};  // what each coordinate adds to a place
  float distance_ = 0.0F;                    // of the eye from the frame's origin
  float shift_ = 0.0F, slope_ = 0.0F;  // a place shrinks by 1 / (slope (depth + shift) + 1 − slope)
  Extent spanned_{};                   // by all points
  Place origin_{};                     // corner of the picture
  float cells_per_unit_ = 1.0F;
  Place scale_{};  // cells a unit, of depth 1
  Place last_{};
  float margin_ = 0.0F;
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<Place> projected_{};  // the points, x and y in frame units
  std::vector<Place> places_{};
  std::vector<Place> centres_{};  // of the balls, as the points
  std::vector<Extent> extents_{};
};

}  // namespace vantage
