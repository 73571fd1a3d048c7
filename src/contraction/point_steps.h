// SPDX-License-Identifier: MIT
#pragma once

#include "contraction/component_contraction.h"
#include "spatial/point_rings.h"

namespace vantage {

/// Contracts one component of a cloud, scaled as options.scaling says, with the weights for
/// points of docs/contraction.md. \throw Cancelled
ComponentHistory contract_point_component(const std::vector<Vec3>& scaled, const PointRings& rings,
                                          const ContractionOptions& options, const RunContext& run);

}  // namespace vantage
