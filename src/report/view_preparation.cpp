// SPDX-License-Identifier: MIT
#include "report/view_preparation.h"

#include "vantage/mesh/measures.h"

#include "view/sketch_scorer.h"

namespace vantage {
namespace {

constexpr std::size_t kEyes = 200;  // of a search, about

}  // namespace

Posture::Posture(const TriMesh& surface)
    : planes(mirror_planes(surface)),
      with_y_up(stance(surface, up_vector(UpAxis::Y), planes)),
      with_z_up(stance(surface, up_vector(UpAxis::Z), planes)) {}

ViewPreparation::ViewPreparation(const ShapeAnalysis& shape)
    : visibility(shape.surface, shape.sides, kEyes),
      posture(shape.surface),
      walls(flat_parts(shape.surface)),
      landmarks(landmark_directions(shape.surface, walls)),
      vertex_areas(vantage::vertex_areas(shape.surface)),
      coarse(std::make_shared<SketchSurface>(
          sketch_surface(shape.surface, shape.sides, shape.sphere,
                         sketch_options(shape.surface.positions.size()).faces))) {}

Posture posture_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views->posture : Posture(shape.surface);
}

std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views : std::make_shared<ViewPreparation>(shape);
}

}  // namespace vantage
