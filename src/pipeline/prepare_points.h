// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "vantage/pipeline/shape_analysis.h"

namespace vantage {

/// What is wrong with a model, behind its name if it has one.
std::string about_model(const std::string& name, const std::string& problem);

/// \throw InvalidInput if nothing can be computed with points so large, small or far away.
void check_extent(std::span<const Vec3> points, const std::string& name);

/// Warns of coordinates that hold few places across the points.
void list_coarse_coordinates(std::span<const Vec3> points, std::vector<std::string>& warnings);

/// prepare_surface() for a model without faces: welds, finds outliers, and joins the points by the
/// triangles that their local Delaunay rings hold. Lists everything left out in `warnings`.
/// \throw InvalidInput if the points have no extent or all lie on one line; Cancelled
ShapeAnalysis prepare_points(const Model& model, const RunContext& run);

/// The contraction of a cloud, with what the skeleton needs of it. \throw Cancelled
void add_point_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run);

/// The skeleton of the contracted samples, carried to all points. \throw Cancelled
void add_point_skeleton(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run);

}  // namespace vantage
