// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/render/render.h"

#include "render/surface_materials.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// A place of a surface that is seen.
struct SurfacePlace {
  Vec3f position = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();       ///< As shaded, on the viewer's side.
  Vec3f face_normal = Vec3f::UnitZ();  ///< Of the flat face, on the viewer's side.
};

/// What pictures of a surface share, whatever the camera: its search tree, normals and materials, in
/// one unit frame. Immutable; may be asked from many threads at once.
class DrawnSurface {
 public:
  /// \param appearance may be null; must outlive this. \throw InvalidInput, Cancelled
  DrawnSurface(const TriMesh& mesh, const Appearance* appearance, double crease_deg,
               const RunContext& run);
  DrawnSurface(const DrawnSurface&) = delete;
  DrawnSurface& operator=(const DrawnSurface&) = delete;

  [[nodiscard]] const UnitFrame& frame() const { return frame_; }

  /// In the frame.
  [[nodiscard]] const TriMesh& mesh() const { return mesh_; }

  /// Largest distance of a face from the frame's origin, > 0.
  [[nodiscard]] double reach() const { return reach_; }

  [[nodiscard]] double crease_deg() const { return crease_deg_; }

  [[nodiscard]] const RayScene& rays() const { return *rays_; }

  /// Null if nothing is known of its materials.
  [[nodiscard]] const SurfaceMaterials* materials() const {
    return materials_ ? &*materials_ : nullptr;
  }

  /// Where a ray with a unit direction hits the surface.
  [[nodiscard]] SurfacePlace place(const RaySegment& ray, const RayHit& hit) const;

 private:
  UnitFrame frame_;
  TriMesh mesh_;
  double reach_ = 1.0;
  double crease_deg_;
  std::vector<Vec3f> face_normals_{};            // unit; zero of faces without area
  std::vector<std::array<Vec3f, 3>> normals_{};  // at corners; empty: the faces' own
  std::optional<SurfaceMaterials> materials_{};
  std::optional<RayScene> rays_{};
};

}  // namespace vantage
