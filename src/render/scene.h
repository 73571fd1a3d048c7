// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/render/render.h"

#include "render/contours.h"
#include "render/ground.h"
#include "render/occlusion.h"
#include "render/openness_filter.h"
#include "render/picture_rays.h"
#include "render/shading.h"
#include "render/skin.h"
#include "render/tile_mask.h"
#include "render/tubes.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// Light that comes from a point of the picture, multiplied by its opacity.
struct Light {
  Vec3 colour = Vec3::Zero();
  double alpha = 0.0;

  /// Puts more light behind what is there.
  void behind(const Vec3& other, double opacity) {
    colour += (1.0 - alpha) * opacity * other;
    alpha += (1.0 - alpha) * opacity;
  }
};

/// What is known of some rows of a picture before their pixels are made.
struct SceneBand {
  int first_row = 0;
  std::vector<double> outlines{};      ///< Coverage of each pixel; empty if the style has none.
  std::vector<SurfaceProbe> probes{};  ///< Of each pixel's middle; empty without occlusion rays.
};

/// Everything to be drawn, in one unit frame. Immutable after construction; pixels may be asked
/// for from many threads at once.
class Scene {
 public:
  /// \throw InvalidInput, Cancelled
  Scene(const TriMesh& mesh, const Camera& camera, const Paint& paint, const RenderOptions& options,
        const RunContext& run);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Prepares some rows. \throw Cancelled
  [[nodiscard]] SceneBand band(int first_row, int rows, const RunContext& run) const;

  /// Light and opacity of a pixel of a band: the colour is not multiplied by the opacity.
  [[nodiscard]] Light pixel(int x, int y, const SceneBand& band) const;

 private:
  /// A place of the surface that is seen.
  struct Place {
    Vec3 position = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();       ///< As shaded, on the viewer's side.
    Vec3 face_normal = Vec3::UnitZ();  ///< Of the flat face, on the viewer's side.
  };

  void add_lines(double reach, const RunContext& run);
  [[nodiscard]] Light sample(const PictureRay& ray, int x, int y, std::size_t index,
                             const SceneBand& band) const;
  [[nodiscard]] Place place_of(const PictureRay& ray, const RayHit& hit) const;
  [[nodiscard]] SurfaceProbe probe(int x, int y) const;
  [[nodiscard]] double openness(const Place& place, int x, int y, std::size_t index,
                                const SceneBand& band) const;
  [[nodiscard]] std::size_t band_index(int x, int y, const SceneBand& band) const;
  [[nodiscard]] double shadow(const PictureRay& ray, double t, int x, int y) const;
  [[nodiscard]] RayHit nearest(const PictureRay& ray, int x, int y) const;
  [[nodiscard]] Vec3 to_camera(const Vec3& vector) const;
  [[nodiscard]] Skin::Shown shown_at(const RayHit& hit) const;
  [[nodiscard]] Light surface_light(const PictureRay& ray, const RayHit& hit, int x, int y,
                                    std::size_t index, const SceneBand& band,
                                    bool before_tube) const;
  [[nodiscard]] Vec3 background(int y) const;

  RenderOptions options_;
  TriMesh mesh_;
  std::vector<std::array<Vec3f, 3>> normals_{};
  std::vector<Vec3f> colour_of_vertex_{};
  Vec3 colour_;
  double pixel_ = 0.0;  // size of a pixel at the middle of the scene
  std::vector<std::array<double, 2>> pattern_;
  std::optional<Skin> skin_{};
  std::optional<RayScene> surface_{};
  std::optional<TileMask> mask_{};
  std::optional<PictureRays> rays_{};
  std::optional<Occlusion> occlusion_{};
  std::optional<Ground> ground_{};
  std::optional<Tubes> tubes_{};
  std::optional<Tubes> creases_{};
  std::optional<Contours> contours_{};
  Vec3 tube_colour_;
};

}  // namespace vantage
