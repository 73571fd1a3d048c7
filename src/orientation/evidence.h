// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "vantage/orientation/orientation.h"

#include "orientation/axis_direction.h"
#include "orientation/measured_sides.h"

/// \file
/// What speaks for and against a direction: numbers with names, of which the fitted trees ask some. All
/// are free of the model's scale. docs/orientation.md says what they are taken from.

namespace vantage {

using Evidence = std::vector<OrientationFeature>;

/// Area vectors of a closed surface add up to nothing. Where what they leave is more than this share of
/// the area, the surface has one side to be seen from, as scans and reliefs have. [ours]
inline constexpr double kOneSided = 0.25;

/// Evidence for a direction being up.
Evidence upright_evidence(const MeasuredSides& sides, AxisDirection up);

/// Evidence for a direction being the front, if `up` is up. \pre they have different axes.
Evidence front_evidence(const MeasuredSides& sides, AxisDirection up, AxisDirection front);

/// \pre there is one of that name
double value_of(std::string_view name, const Evidence& evidence);

/// A part over the whole, 0 if there is next to nothing.
double share_of(double part, double whole);

/// log2 of a over b, sides of a box over its longest; finite where one of them is 0.
double log_ratio(double a, double b);

}  // namespace vantage
