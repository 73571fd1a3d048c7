// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/skeleton/skeleton.h"

namespace vantage::test {

/// The skeleton of a mesh that is contracted with the default options.
Skeleton skeleton_of(const TriMesh& mesh, const SkeletonOptions& options = {});

/// The nodes of one edge.
std::vector<Vec3> ends_of(const CurveGraph& graph);

/// Component 0 for every vertex.
std::vector<std::uint32_t> one_component(const TriMesh& mesh);

}  // namespace vantage::test
