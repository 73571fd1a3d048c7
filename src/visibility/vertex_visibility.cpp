// SPDX-License-Identifier: MIT
#include "vantage/visibility/vertex_visibility.h"

#include "visibility/vertex_scene.h"

namespace vantage {

VertexVisibility::VertexVisibility(const TriMesh& mesh, std::vector<FaceSides> sides)
    : scene_(std::make_unique<Scene>(prepare_surface(mesh, sides))) {}

VertexVisibility::~VertexVisibility() = default;
VertexVisibility::VertexVisibility(VertexVisibility&&) noexcept = default;
VertexVisibility& VertexVisibility::operator=(VertexVisibility&&) noexcept = default;

std::vector<std::uint8_t> VertexVisibility::visible_vertices(const Viewpoint& eye,
                                                             const RunContext& run) const {
  Sight& sight = scene_->sight;
  Look look(sight, eye_in_frame(eye, sight.surface().frame), run);
  return vertices_of_sites(sight.surface(), look.seen_sites());
}

std::vector<std::uint8_t> visible_vertices(const TriMesh& mesh, const Vec3& eye) {
  OrientedMesh oriented = orient_shells(mesh);
  return VertexVisibility(oriented.mesh, std::move(oriented.sides))
      .visible_vertices({Projection::Perspective, eye});
}

}  // namespace vantage
