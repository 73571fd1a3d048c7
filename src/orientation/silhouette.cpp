// SPDX-License-Identifier: MIT
#include "orientation/silhouette.h"

namespace vantage {
namespace {

// Sheets have mass, too: what a column has besides its height, over the box's longest side.
constexpr double kLeastMass = 1e-3;
// A cell is high if its depth from above is less than this, over the box's height.
constexpr double kHigh = 0.4;
// What is near a side of the box, over its depth.
constexpr double kNear = 0.25;

}  // namespace

Bands bands_of(const HeightField& field, AxisDirection up) {
  const bool up_is_row = field.v_axis == up.axis;
  const std::size_t heights = up_is_row ? field.rows : field.columns;
  const std::size_t places = up_is_row ? field.columns : field.rows;
  Bands bands;
  std::array<double, kBands> filled{};
  std::array<double, kBands> cells{};
  std::array<double, kBands> lines{};
  double all = 0.0;
  for (std::size_t h = 0; h < heights; ++h) {
    const std::size_t line = up.is_positive ? h : heights - 1 - h;
    const std::size_t band = h * kBands / heights;
    bool was_filled = false;
    lines[band] += 1.0;
    for (std::size_t p = 0; p < places; ++p) {
      const bool is_filled =
          field.is_filled(up_is_row ? line * field.columns + p : p * field.columns + line);
      cells[band] += 1.0;
      if (is_filled) {
        filled[band] += 1.0;
        bands.runs[band] += was_filled ? 0.0 : 1.0;
        bands.middle[band] += (static_cast<double>(p) + 0.5) / static_cast<double>(places);
        bands.mean_height += (static_cast<double>(h) + 0.5) / static_cast<double>(heights);
        all += 1.0;
      }
      was_filled = is_filled;
    }
  }
  for (std::size_t b = 0; b < kBands; ++b) {
    bands.width[b] = cells[b] > 0.0 ? filled[b] / cells[b] : 0.0;
    bands.runs[b] = lines[b] > 0.0 ? bands.runs[b] / lines[b] : 0.0;
    bands.middle[b] = filled[b] > 0.0 ? bands.middle[b] / filled[b] : 0.5;
  }
  bands.mean_height = all > 0.0 ? bands.mean_height / all : 0.5;
  return bands;
}

Columns columns_of(const HeightField& field, bool up_is_positive) {
  Columns result;
  double mass = 0.0;
  double along = 0.0;
  double cells = 0.0;
  double tall = 0.0;
  Columns sum;
  sum.mass_u = sum.mass_v = sum.outline_u = sum.outline_v = sum.high_u = sum.high_v = 0.0;
  for (std::size_t cell = 0; cell < field.low.size(); ++cell) {
    if (!field.is_filled(cell)) {
      continue;
    }
    const double u =
        (static_cast<double>(cell % field.columns) + 0.5) / static_cast<double>(field.columns);
    const std::size_t row = cell / field.columns;
    const double v = (static_cast<double>(row) + 0.5) / static_cast<double>(field.rows);
    const double low = field.low[cell];
    const double high = field.high[cell];
    const double here = high - low + kLeastMass;
    mass += here;
    along += here * 0.5 * (low + high);
    sum.mass_u += here * u;
    sum.mass_v += here * v;
    sum.outline_u += u;
    sum.outline_v += v;
    cells += 1.0;
    if (field.depth(cell, up_is_positive) < kHigh * field.extent) {
      sum.high_u += u;
      sum.high_v += v;
      tall += 1.0;
    }
  }
  if (cells > 0.0) {
    result.mass_along = field.extent > 0.0 ? along / mass / field.extent : 0.5;
    result.mass_u = sum.mass_u / mass;
    result.mass_v = sum.mass_v / mass;
    result.outline_u = sum.outline_u / cells;
    result.outline_v = sum.outline_v / cells;
    result.high_u = tall > 0.0 ? sum.high_u / tall : 0.5;
    result.high_v = tall > 0.0 ? sum.high_v / tall : 0.5;
    result.filled = cells / static_cast<double>(field.low.size());
  }
  return result;
}

NearHeights near_heights(const HeightField& depths, AxisDirection up, AxisDirection front) {
  double ahead_height = 0.0;
  double behind_height = 0.0;
  double near_ahead = 0.0;
  double near_behind = 0.0;
  const double limit = kNear * depths.extent;
  const bool row_is_up = depths.v_axis == up.axis;
  for (std::size_t cell = 0; cell < depths.low.size(); ++cell) {
    if (!depths.is_filled(cell)) {
      continue;
    }
    const std::size_t row = cell / depths.columns;
    const std::size_t column = cell % depths.columns;
    const double place =
        row_is_up ? (static_cast<double>(row) + 0.5) / static_cast<double>(depths.rows)
                  : (static_cast<double>(column) + 0.5) / static_cast<double>(depths.columns);
    const double height = oriented(place, up);
    if (depths.depth(cell, front.is_positive) <= limit) {
      ahead_height += height;
      near_ahead += 1.0;
    }
    if (depths.depth(cell, !front.is_positive) <= limit) {
      behind_height += height;
      near_behind += 1.0;
    }
  }
  return {near_ahead > 0.0 ? ahead_height / near_ahead : 0.5,
          near_behind > 0.0 ? behind_height / near_behind : 0.5};
}

}  // namespace vantage
