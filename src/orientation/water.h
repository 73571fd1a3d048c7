// SPDX-License-Identifier: MIT
#pragma once

#include "orientation/height_fields.h"

namespace vantage {

/// Depth of the rain that stays where it falls on one side of a surface, mean over its outline, over
/// the field's depth: what cups, tubs and trays hold if that side is up. Cells without a surface drain.
double rain_held(const HeightField& field, bool from_high);

}  // namespace vantage
