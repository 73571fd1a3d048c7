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
  const Surface& surface = scene_->sight.surface();
  const std::vector<std::uint8_t> seen =
      scene_->sight.seen_sites(eye_in_frame(eye, surface.frame), run);
  std::vector<std::uint8_t> visible(surface.site_of_vertex.size(), 0);
  for (std::size_t v = 0; v < visible.size(); ++v) {
    const std::uint32_t site = surface.site_of_vertex[v];
    visible[v] = site == Surface::kNoSite ? std::uint8_t{0} : seen[site];
  }
  return visible;
}

std::vector<std::uint8_t> visible_vertices(const TriMesh& mesh, const Vec3& eye) {
  OrientedMesh oriented = orient_shells(mesh);
  return VertexVisibility(oriented.mesh, std::move(oriented.sides))
      .visible_vertices({Projection::Perspective, eye});
}

}  // namespace vantage
