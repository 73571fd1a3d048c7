// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/contraction/history.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "skeleton/collapsed.h"

namespace vantage {

/// The graph of a contracted cloud by sampling and thinning (Cao 2010): farthest points at `spacing`
/// among the last positions, joined where the points nearest to them are neighbours, and collapsed
/// until no three are joined to each other.
/// \param samples points of the cloud and triangles whose sides say which are neighbours.
Collapsed thin_cloud(const TriMesh& samples, const ContractionHistory& history, double spacing,
                     const RunContext& run);

}  // namespace vantage
