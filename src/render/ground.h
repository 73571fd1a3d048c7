// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "render/occlusion.h"
#include "render/picture_rays.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// A level ground under a model that shows nothing but the model's soft shadow on it: what part of
/// the sky each of its points sees, computed once on a grid, so that it has no grain.
class Ground {
 public:
  /// The ground touches the model from below. \param mesh in the frame of the scene.
  /// \param reach how far away the model still darkens it. \throw Cancelled
  Ground(const TriMesh& mesh, const RayScene& scene, const Vec3& up, double reach,
         const RunContext& run);

  [[nodiscard]] const Floor& floor() const { return floor_; }

  /// Where the ray meets the ground from above; infinity if it does not.
  [[nodiscard]] double meet(const PictureRay& ray) const;

  /// Blocked part of the sky over a point of the ground, in [0, 1]; 0 far from the model.
  [[nodiscard]] double shadow(const Vec3& point) const;

 private:
  [[nodiscard]] double cell(int column, int row) const;

  Floor floor_;
  Vec3 across_ = Vec3::UnitX();
  Vec3 along_ = Vec3::UnitZ();
  double left_ = 0.0;
  double bottom_ = 0.0;
  double cell_ = 1.0;
  std::vector<double> shadows_{};
};

}  // namespace vantage
