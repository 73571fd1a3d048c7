// SPDX-License-Identifier: MIT
#include "vantage/visibility/face_visibility.h"

#include <cmath>
#include <string>

#include "core/sizes.h"
#include "visibility/face_query.h"

namespace vantage {

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides)
    : scene_(std::make_unique<FaceScene>(mesh, sides)) {}

FaceVisibility::~FaceVisibility() = default;
FaceVisibility::FaceVisibility(FaceVisibility&&) noexcept = default;
FaceVisibility& FaceVisibility::operator=(FaceVisibility&&) noexcept = default;

double FaceVisibility::total_area() const {
  return scene_->total_area;
}

double FaceVisibility::area_unit() const {
  const double area = total_area();
  return area > 0.0 && std::isfinite(area) ? std::exp2(std::ilogb(area)) : 1.0;
}

std::size_t FaceVisibility::face_count() const {
  return scene_->triangles.size();
}

double FaceVisibility::face_area(std::size_t face) const {
  if (face >= face_count()) {
    throw InvalidInput("there is no face " + std::to_string(face) + ": the mesh has " +
                       std::to_string(face_count()) + ", counted from 0");
  }
  const Surface& surface = scene_->samples.surface();
  const std::uint32_t at = scene_->face_of_mesh[face];
  const double unit = surface.frame.scale;
  return at == FaceScene::kNoFace ? 0.0 : 0.5 * surface.twice_areas[at] / (unit * unit);
}

std::vector<SeenFace> FaceVisibility::seen_faces(const Viewpoint& eye,
                                                 const RunContext& run) const {
  return seen_surface(eye, run).faces;
}

SeenSurface FaceVisibility::seen_surface(const Viewpoint& eye, const RunContext& run,
                                         FaceDetail detail) const {
  return see_faces(*scene_, eye_in_frame(eye, scene_->samples.surface().frame), detail, run);
}

std::vector<std::uint8_t> FaceVisibility::visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run) const {
  const Surface& surface = scene_->samples.surface();
  SampleQuery query(scene_->samples, eye_in_frame(eye, surface.frame), run);
  return vertices_of_samples(surface, query.seen_samples());
}

std::vector<double> FaceVisibility::integrals(std::span<const double> of_vertex) const {
  require_count(of_vertex.size(), "values of the field",
                scene_->samples.surface().sample_of_vertex.size(), "vertices");
  std::vector<double> of_face;
  of_face.reserve(face_count());
  for (std::size_t f = 0; f < face_count(); ++f) {
    const auto& [a, b, c] = scene_->triangles[f];
    of_face.push_back(face_area(f) * (of_vertex[a] + of_vertex[b] + of_vertex[c]) / 3.0);
  }
  return of_face;
}

double FaceVisibility::visible_integral(std::span<const double> of_vertex,
                                        std::span<const SeenFace> seen) const {
  require_count(of_vertex.size(), "values of the field",
                scene_->samples.surface().sample_of_vertex.size(), "vertices");
  double sum = 0.0;
  for (const SeenFace& face : seen) {
    const auto& [a, b, c] = scene_->triangles[face.face];
    sum += face.of_corners[0] * of_vertex[a] + face.of_corners[1] * of_vertex[b] +
           face.of_corners[2] * of_vertex[c];
  }
  return sum;
}

}  // namespace vantage
