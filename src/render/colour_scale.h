// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// A map's values in [0, 1], as colour_map() scales them; NaN stays.
std::vector<float> shares_of_range(std::span<const double> values);

/// cool_warm() of a share, linear. Looked up: asked for every place that a ray hits.
const Vec3& linear_cool_warm(float share);

}  // namespace vantage
