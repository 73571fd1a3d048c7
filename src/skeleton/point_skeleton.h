// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/skeleton/skeleton.h"

namespace vantage {

/// extract_skeleton() for the samples of a cloud, joined by the triangles of their rings. Their
/// genus is unknown and gaps between the triangles leave loops that are no handles, so loops that no
/// tube could have are closed: those shorter than 2π times the mean radius of their nodes. (A tube
/// of radius ρ bent into a ring has an axis of at least 2πρ, or it would run through itself.)
/// \throw InvalidInput, Cancelled
Skeleton extract_point_skeleton(const TriMesh& samples, const ContractionHistory& history,
                                const SkeletonOptions& options = {}, const RunContext& run = {});

}  // namespace vantage
