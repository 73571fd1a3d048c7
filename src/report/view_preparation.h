// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "vantage/report/view_report.h"
#include "vantage/spatial/mirror_symmetry.h"
#include "vantage/view/landmarks.h"
#include "vantage/view/stance.h"
#include "vantage/visibility/vertex_visibility.h"

#include "view/sketch_surface.h"

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

  std::uint64_t surface_print;  ///< Of the surface and the sides that it is of.
  VertexVisibility visibility;
  Posture posture;
  std::vector<FlatPart> walls;                  ///< flat_parts().
  std::vector<Vec3> landmarks;                  ///< landmark_directions().
  std::vector<double> vertex_areas;             ///< vertex_areas().
  std::shared_ptr<const SketchSurface> coarse;  ///< For a SketchScorer by sketch_options().
};

/// That of the shape if it is of its surface as that is now, else null.
const ViewPreparation* views_of(const ShapeAnalysis& shape);

/// That of the shape, or one found now.
Posture posture_of(const ShapeAnalysis& shape);

/// That of the shape, or one made now.
std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape);

/// The visibility of these, or one made now for about so many eyes.
std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape, std::size_t eyes);

}  // namespace vantage
