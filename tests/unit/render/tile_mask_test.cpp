// SPDX-License-Identifier: MIT
#include "render/tile_mask.h"

#include <gtest/gtest.h>

#include "spatial/ray_scene.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 44;

struct Found {
  int missed = 0;  ///< Samples that meet the surface where the mask says that none does.
  int empty = 0;   ///< Pixels that need no ray.
};

/// \param camera of a mesh that lies in the unit frame already.
Found compare(const TriMesh& mesh, const Camera& camera, double pixel = 0.05) {
  const PictureRays rays(camera, {}, 2.0, kWidth, kHeight);
  const TileMask mask(mesh, rays, pixel, kWidth, kHeight);
  const RayScene scene(mesh);
  Found found;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      found.empty += mask.may_show(x, y) ? 0 : 1;
      for (const double shift : {-0.75, 0.0, 0.75}) {
        const PictureRay ray = rays.ray(x + 0.5 + shift, y + 0.5 - shift);
        const bool hit =
            ray.can_hit && scene.closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>());
        found.missed += hit && !mask.may_show(x, y) ? 1 : 0;
      }
    }
  }
  return found;
}

Camera from(const Vec3& eye, double fov_y_deg) {
  Camera camera;
  camera.eye = eye;
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

TEST(TileMask, MissesNoSampleAndLeavesTheCornersOut) {
  for (const Vec3& eye : {Vec3(0, 0.5, 6), Vec3(5, 3, 1), Vec3(0.1, 4, 0.1)}) {
    const Found found = compare(torus(0.8, 0.25, 40, 20), from(eye, 40.0));
    EXPECT_EQ(found.missed, 0);
    EXPECT_GT(found.empty, kWidth * kHeight / 4);
  }
}

TEST(TileMask, MissesNothingOrthographically) {
  Camera camera = from({1, 2, 3}, 30.0);
  camera.projection = Projection::Orthographic;
  camera.height = 3.0;
  const Found found = compare(box(1, 1, 1, 2), camera);
  EXPECT_EQ(found.missed, 0);
  EXPECT_GT(found.empty, 0);
}

TEST(TileMask, SaysNothingWhereTheEyeIsInsideOrAPixelIsTiny) {
  const TriMesh shell = sphere(2);
  EXPECT_EQ(compare(shell, from({0, 0, 0.2}, 60.0)).empty, 0);
  EXPECT_EQ(compare(shell, from({0, 0, 6}, 60.0), 1e-6).empty, 0);
}

}  // namespace
}  // namespace vantage::test
