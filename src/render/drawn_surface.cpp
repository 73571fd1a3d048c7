// SPDX-License-Identifier: MIT
#include "render/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vantage/mesh/measures.h"

#include "core/degrees.h"
#include "core/parallel.h"
#include "render/corner_normals.h"

namespace vantage {
namespace {

/// Edges turn from smooth to crisp within so much on either side of the crease angle [ours]: at the
/// default of 40° rounded fillets of CAD parts, rarely split finer than 12 to the full turn, stay
/// smooth and their chamfers sharp, and bends of scans do not fray into teeth.
constexpr double kCreaseSoftnessDeg = 10.0;
constexpr std::size_t kFaceGrain = 4096;
/// Least cosine between a shading normal and the viewer; interpolated normals may lean away.
constexpr float kLeastFacing = 0.02F;

/// The normal turned until it faces the viewer at least a little.
Vec3f facing_normal(const Vec3f& normal, const Vec3f& to_viewer) {
  const float cosine = normal.dot(to_viewer);
  if (cosine >= kLeastFacing) {
    return normal;
  }
  return (normal + (kLeastFacing - cosine) * to_viewer).normalized();
}

Crease crease_of(double crease_deg) {
  return {std::max(0.0, crease_deg - kCreaseSoftnessDeg) * kRadPerDeg,
          (crease_deg + kCreaseSoftnessDeg) * kRadPerDeg};
}

double reach_of(const TriMesh& mesh) {
  double squared = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      squared = std::max(squared, mesh.positions[v].squaredNorm());
    }
  }
  return squared > 0.0 ? std::sqrt(squared) : 1.0;
}

}  // namespace

DrawnSurface::DrawnSurface(const TriMesh& mesh, const Appearance* appearance, double crease_deg,
                           const RunContext& run)
    : frame_(unit_frame(referenced_points(mesh))), mesh_(mesh), crease_deg_(crease_deg) {
  for (Vec3& position : mesh_.positions) {
    position = frame_.to_frame(position);
  }
  reach_ = reach_of(mesh_);
  face_normals_.resize(mesh_.triangles.size(), Vec3f::Zero());
  parallel_for(run, face_normals_.size(), kFaceGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 area = area_vector(mesh_, mesh_.triangles[f]);
      const double norm = area.norm();
      face_normals_[f] = norm > 0.0 ? Vec3f((area / norm).cast<float>()) : Vec3f(Vec3f::Zero());
    }
  });
  if (crease_deg > 0.0) {
    normals_ = corner_normals(mesh_, crease_of(crease_deg), run);
  }
  run.check();
  if (appearance != nullptr && !appearance->materials.empty()) {
    materials_.emplace(*appearance, mesh_);
  }
  OpacityOfHit opacity;
  if (materials_ && materials_->has_openings()) {
    opacity = [this](std::uint32_t face, float u, float v, float width) {
      return materials_->at(face, u, v, static_cast<double>(width)).opacity;
    };
  }
  rays_.emplace(mesh_, std::move(opacity));
}

SurfacePlace DrawnSurface::place(const RaySegment& ray, const RayHit& hit) const {
  const Vec3f to_viewer = -ray.direction;
  const Vec3f& face_normal = face_normals_[hit.face];
  SurfacePlace place;
  place.position = ray.origin + hit.t * ray.direction;
  place.face_normal = face_normal.isZero(0.0F) ? to_viewer : face_normal;
  place.normal = place.face_normal;
  if (!normals_.empty()) {
    const std::array<Vec3f, 3>& corners = normals_[hit.face];
    const Vec3f mixed =
        (1.0F - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
    const float length = mixed.norm();
    place.normal = length > 0.0F ? Vec3f(mixed / length) : place.face_normal;
  }
  if (place.face_normal.dot(to_viewer) < 0.0F) {
    place.face_normal = -place.face_normal;
    place.normal = -place.normal;
  }
  place.normal = facing_normal(place.normal, to_viewer);
  return place;
}

}  // namespace vantage
