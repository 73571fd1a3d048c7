// SPDX-License-Identifier: MIT
#include "vantage/visibility/vertex_visibility.h"

#include <utility>

#include "core/sizes.h"
#include "mesh/surface_edges.h"
#include "spatial/face_meetings.h"
#include "visibility/sample_query.h"

namespace vantage {

struct VertexVisibility::Scene {
  explicit Scene(Surface surface) : samples(std::move(surface)) {}

  SampleScene samples;
};

namespace {

// From so many eyes on it pays to find the back faces that occlude nothing: that takes as long as twenty
// queries, and spares each a fifth. [ours, by measurement]
constexpr std::size_t kManyEyes = 100;

Surface surface_for(const TriMesh& mesh, std::span<const FaceSides> sides, std::size_t eyes) {
  Surface surface = visibility_surface(mesh, sides);
  if (eyes >= kManyEyes && !surface.faces.empty()) {
    const TriMesh framed{surface.samples, surface.faces};
    surface.back_faces = find_meetings(framed, surface_edges(framed)).occluding_back_faces;
  }
  return surface;
}

/// \throw InvalidInput unless there is a flag a vertex
std::vector<std::uint8_t> samples_of(const Surface& surface, std::span<const std::uint8_t> asked) {
  require_count(asked.size(), "flags of the vertices asked about", surface.sample_of_vertex.size(),
                "vertices");
  std::vector<std::uint8_t> samples(surface.samples.size(), 0);
  for (std::size_t v = 0; v < asked.size(); ++v) {
    if (asked[v] != 0 && surface.sample_of_vertex[v] != Surface::kNoSample) {
      samples[surface.sample_of_vertex[v]] = 1;
    }
  }
  return samples;
}

/// Of vertices at one sample perhaps only some were asked about.
std::vector<std::uint8_t> of_those_asked(const Surface& surface,
                                         std::span<const std::uint8_t> asked,
                                         const std::vector<std::uint8_t>& seen_samples) {
  std::vector<std::uint8_t> seen = vertices_of_samples(surface, seen_samples);
  for (std::size_t v = 0; v < seen.size(); ++v) {
    seen[v] = asked[v] != 0 ? seen[v] : 0;
  }
  return seen;
}

}  // namespace

VertexVisibility::VertexVisibility(const TriMesh& mesh, std::vector<FaceSides> sides,
                                   std::size_t eyes)
    : scene_(std::make_unique<Scene>(surface_for(mesh, sides, eyes))) {}

VertexVisibility::~VertexVisibility() = default;
VertexVisibility::VertexVisibility(VertexVisibility&&) noexcept = default;
VertexVisibility& VertexVisibility::operator=(VertexVisibility&&) noexcept = default;

std::vector<std::uint8_t> VertexVisibility::visible_vertices(const Viewpoint& eye,
                                                             const RunContext& run) const {
  SampleScene& samples = scene_->samples;
  SampleQuery query(samples, eye_in_frame(eye, samples.surface().frame), run);
  return vertices_of_samples(samples.surface(), query.seen_samples());
}

std::vector<std::uint8_t> VertexVisibility::visible_among(std::span<const std::uint8_t> asked,
                                                          const Viewpoint& eye,
                                                          const RunContext& run) const {
  SampleScene& samples = scene_->samples;
  SampleQuery query(samples, eye_in_frame(eye, samples.surface().frame), run);
  return of_those_asked(samples.surface(), asked,
                        query.seen_among(samples_of(samples.surface(), asked)));
}

std::vector<std::uint8_t> VertexVisibility::visible_by_segments(std::span<const std::uint8_t> asked,
                                                                const Viewpoint& eye,
                                                                const RunContext& run) const {
  SampleScene& samples = scene_->samples;
  SampleQuery query(samples, eye_in_frame(eye, samples.surface().frame), run);
  return of_those_asked(samples.surface(), asked,
                        query.seen_by_segments(samples_of(samples.surface(), asked)));
}

std::vector<std::uint8_t> visible_vertices(const TriMesh& mesh, const Vec3& eye) {
  OrientedMesh oriented = orient_shells(mesh);
  return VertexVisibility(oriented.mesh, std::move(oriented.sides))
      .visible_vertices({Projection::Perspective, eye});
}

}  // namespace vantage
