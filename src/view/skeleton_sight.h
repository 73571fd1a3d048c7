// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/view/measure.h"

/// \file
/// How much of the skeleton a view shows.

namespace vantage {

/// A node is shown if the eye sees at least half of the area that its part of the surface turns to
/// the eye; an edge as its nodes are, on average. Nodes that stand for no surface are left out.
/// \pre the model has a skeleton, the table vertices.
SkeletonSight skeleton_sight(const MeasuredModel& model, const SightTable& sight);

}  // namespace vantage
