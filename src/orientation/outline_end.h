// SPDX-License-Identifier: MIT
#pragma once

#include "orientation/axis_direction.h"
#include "orientation/height_fields.h"

namespace vantage {

/// A silhouette's end, as heads and tails are seen.
struct EndOfOutline {
  double filled = 0.0;  ///< Share of the cells.
  double height = 0.5;  ///< Mean place along `across`.
};

/// \param end the side that the part lies at. \param from, to shares of the length from that side.
EndOfOutline end_of(const HeightField& field, AxisDirection end, AxisDirection across, double from,
                    double to);

}  // namespace vantage
