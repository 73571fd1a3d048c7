// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "orientation/axis_direction.h"
#include "orientation/height_fields.h"

/// \file
/// Silhouettes and columns of a surface: what its height fields say of its outline and its mass.

namespace vantage {

/// A silhouette is cut into so many bands across the height.
inline constexpr std::size_t kBands = 8;

/// A silhouette from the side, by bands of height from the ground.
struct Bands {
  std::array<double, kBands> width{};   ///< Filled share of the band.
  std::array<double, kBands> runs{};    ///< Mean number of separate runs in its rows.
  std::array<double, kBands> middle{};  ///< Mean place along the row, share of the row.
  double mean_height = 0.0;             ///< Of the silhouette, share of the height.
};

/// \param field whose cells have `up` as one coordinate.
Bands bands_of(const HeightField& field, AxisDirection up);

/// Mean of what is between the lowest and the highest surface of each cell of a field, and of its
/// cells, along one of the field's own coordinates or its heights; shares of the box's side.
struct Columns {
  double mass_along = 0.5;  ///< Mean height of the columns' mass.
  double mass_u = 0.5;      ///< Mean place of their mass.
  double mass_v = 0.5;
  double outline_u = 0.5;  ///< Mean place of the filled cells.
  double outline_v = 0.5;
  double high_u = 0.5;  ///< Of those cells that reach the upper two fifths from the given side.
  double high_v = 0.5;
  double filled = 0.0;  ///< Share of the cells.
};

/// \param up_is_positive the side that `high` cells are seen from.
Columns columns_of(const HeightField& field, bool up_is_positive);

/// Mean heights of what of a surface is near its front, and near its back.
struct NearHeights {
  double ahead = 0.5;   ///< Share of the height, from the ground.
  double behind = 0.5;  ///< The same.
};

/// \param depths heights along the front's axis.
NearHeights near_heights(const HeightField& depths, AxisDirection up, AxisDirection front);

}  // namespace vantage
