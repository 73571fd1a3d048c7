// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/operators/cotangent_laplacian.h"

#include "contraction/soundness.h"

/// \file
/// What the steps of meshes and of point clouds share: how an ill-conditioned one is made solvable
/// and how far a solved one may reach.

namespace vantage {

/// What has lost less than this has not begun to shrink: on fine smooth surfaces the first steps only
/// round the shape off. The stop rule asks for no progress until then [a_t; ours].
inline constexpr double kBegun = 0.99;

/// Ways to make an ill-conditioned step solvable, tried in order: as defined; non-negative weights
/// and cotangents of angles above half a degree; then also a growing shift of the diagonal.
constexpr int kAsDefined = 0;
constexpr int kMostRegularised = 5;

/// How the Laplacian of a step at this level of regularisation is kept finite.
LaplacianLimits limits_of(const ContractionOptions& options, int regularisation);

/// How far a step at this level may reach.
StepBound bound_of(int regularisation);

/// What is added to the diagonal at this level. \param largest entry of the diagonal.
double shift_of(double largest, int regularisation);

/// Sides of the bounding box that a step from `start` has diverged beyond.
/// \param diameter of the smallest enclosing sphere of `start`.
Vec3 largest_box(const std::vector<Vec3>& start, double diameter);

}  // namespace vantage
