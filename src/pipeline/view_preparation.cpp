// SPDX-License-Identifier: MIT
#include "pipeline/view_preparation.h"

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

// Eyes that a search asks the surface and its coarse copy about, more or less.
constexpr std::size_t kEyes = 300;
constexpr std::size_t kCoarseEyes = 2562;
// Vertices of the coarse copy; fewer lose fingers and tails. [ours, docs/search.md]
constexpr std::size_t kCoarseVertices = 1000;

}  // namespace

ViewPreparation::ViewPreparation(const ShapeAnalysis& shape, const RunContext& run)
    : visibility(shape.surface, shape.sides, kEyes),
      planes((run.check(), mirror_planes(shape.surface))),
      evidence((run.check(), shape.surface)),
      vertex_areas(vantage::vertex_areas(shape.surface)),
      coarse((run.check(),
              coarse_surface(shape.surface, shape.sides, kCoarseVertices, {.stop = run.stop}))),
      coarse_visibility(coarse.mesh, coarse.sides, kCoarseEyes) {}

std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views : std::make_shared<ViewPreparation>(shape);
}

std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape,
                                                      std::size_t eyes) {
  if (shape.views) {
    return {shape.views, &shape.views->visibility};
  }
  return std::make_shared<VertexVisibility>(shape.surface, shape.sides, eyes);
}

std::vector<MirrorPlane> planes_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views->planes : mirror_planes(shape.surface);
}

OrientationEvidence evidence_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views->evidence : OrientationEvidence(shape.surface);
}

}  // namespace vantage
