// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "vantage/pipeline/shape_analysis.h"
#include "vantage/spatial/mirror_symmetry.h"
#include "vantage/visibility/vertex_visibility.h"

#include "pipeline/coarse_surface.h"
#include "view/stance.h"

/// \file
/// What views of a surface are looked for with, whatever its map: made beside the contraction.

namespace vantage {

/// How a surface mirrors itself and stands.
struct Posture {
  explicit Posture(const TriMesh& surface);

  std::vector<MirrorPlane> planes;
  Stance with_y_up;
  Stance with_z_up;
};

/// Immutable; copies of an analysis share it.
struct ViewPreparation {
  /// Of the shape's surface; its history, skeleton and map are not looked at. \throw Cancelled
  explicit ViewPreparation(const ShapeAnalysis& shape, const RunContext& run = {});

  VertexVisibility visibility;
  Posture posture;
  std::vector<double> vertex_areas;    ///< vertex_areas().
  CoarseSurface coarse;                ///< What estimates of scores look at.
  VertexVisibility coarse_visibility;  ///< Of its mesh.
};

/// That of the shape, or one made now.
std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape);

/// The visibility of the shape's, or one made now for about so many eyes.
std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape, std::size_t eyes);

/// The posture of the shape's, or one found now.
Posture posture_of(const ShapeAnalysis& shape);

}  // namespace vantage
