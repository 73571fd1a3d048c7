// SPDX-License-Identifier: MIT
#include "pipeline/view_preparation.h"

#include <algorithm>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/spatial/directions.h"
#include "vantage/visibility/face_visibility.h"

namespace vantage {
namespace {

SeenBySet look_through(const ScoringCamera& camera, const ShapeAnalysis& shape, bool needs_terms,
                       const RunContext& run) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kMeasureSetLevel);
  SeenBySet seen{camera, channel_of(shape, camera, set.directions, run)};
  if (needs_terms) {
    seen.terms = channel_terms(seen.channel, shape.surface, run.quiet());
  }
  return seen;
}

/// Of a face that a view of the set sees: a FaceArea of 8 bytes in the list of the view, another in that of the
/// face. vmi of 345 928 faces took 1.70 GB in all, 1.78 by this. [ours]
constexpr std::uint64_t kBytesPerSeenFace = 16;

}  // namespace

ViewChannel channel_of(const ShapeAnalysis& shape, const ScoringCamera& camera,
                       std::span<const Vec3> directions, const RunContext& run) {
  const FaceVisibility faces(shape.surface, shape.sides);
  return channel_table(faces, camera.viewpoints(directions), run);
}

void require_memory(std::span<const Measure> measures, std::size_t faces,
                    std::uint64_t memory_bytes) {
  const auto of_set = std::find_if(measures.begin(), measures.end(),
                                   [](const Measure& measure) { return measure.is_of_set(); });
  // About half of the faces are seen by each view.
  const std::uint64_t views = 2 + (std::uint64_t{10} << (2U * unsigned{kMeasureSetLevel}));
  const std::uint64_t bytes = views * (std::uint64_t{faces} / 2) * kBytesPerSeenFace;
  if (of_set != measures.end() && bytes > memory_bytes) {
    constexpr std::uint64_t kGigabyte = 1'000'000'000;
    throw InvalidInput(of_set->name + " compares " + std::to_string(views) + " views, which of " +
                       std::to_string(faces) + " faces takes about " +
                       std::to_string(bytes / kGigabyte) + " GB, more than the " +
                       std::to_string(memory_bytes / kGigabyte) +
                       " there are: take another measure, or simplify the model first");
  }
}

ViewPreparation::ViewPreparation(const ShapeAnalysis& shape, const RunContext& run,
                                 const PreparedFor& use)
    : visibility(shape.surface, shape.sides, kEyes),
      planes((run.check(), mirror_planes(shape.surface))),
      evidence((run.check(), shape.surface), shape.flow),
      vertex_areas(vantage::vertex_areas(shape.surface)) {
  if (use.survey) {
    copies = std::make_shared<CoarseCopies>(shape, run, use.survey);
  }
  if (use.measures) {
    set = look_through(*use.measures, shape, use.channel, run);
  }
}

std::shared_ptr<const CoarseCopies> copies_of(const ShapeAnalysis& shape, const RunContext& run) {
  return shape.views && shape.views->copies ? shape.views->copies
                                            : std::make_shared<CoarseCopies>(shape, run);
}

CoarseSurface proxy_of(const ShapeAnalysis& shape, const RunContext& run) {
  return shape.views && shape.views->copies ? shape.views->copies->proxy
                                            : proxy_of_large(shape, run);
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

const SeenBySet* seen_by_set(const ShapeAnalysis& shape, const ScoringCamera& camera) {
  const bool is_known =
      shape.views && shape.views->set && is_same(shape.views->set->camera, camera);
  return is_known ? &*shape.views->set : nullptr;
}

OrientationEvidence evidence_of(const ShapeAnalysis& shape) {
  return shape.views ? shape.views->evidence : OrientationEvidence(shape.surface, shape.flow);
}

}  // namespace vantage
