// SPDX-License-Identifier: MIT
#include "orientation/outline_end.h"

namespace vantage {

namespace {

double from_side(double place, AxisDirection side) {
  return side.is_positive ? 1.0 - place : place;
}

}  // namespace

EndOfOutline end_of(const HeightField& field, AxisDirection end, AxisDirection across, double from,
                    double to) {
  EndOfOutline result;
  double cells = 0.0;
  double filled = 0.0;
  double sum = 0.0;
  for (std::size_t cell = 0; cell < field.low.size(); ++cell) {
    const double u =
        (static_cast<double>(cell % field.columns) + 0.5) / static_cast<double>(field.columns);
    const std::size_t row = cell / field.columns;
    const double v = (static_cast<double>(row) + 0.5) / static_cast<double>(field.rows);
    const double depth = from_side(field.u_axis == end.axis ? u : v, end);
    if (depth < from || depth >= to) {
      continue;
    }
    cells += 1.0;
    if (field.is_filled(cell)) {
      filled += 1.0;
      sum += from_side(field.u_axis == end.axis ? v : u, across.opposite());
    }
  }
  result.filled = cells > 0.0 ? filled / cells : 0.0;
  result.height = filled > 0.0 ? sum / filled : 0.5;
  return result;
}

}  // namespace vantage
