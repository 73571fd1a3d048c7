// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

/// What one picture of the scene shows on and in its surface.
struct Coat {
  std::vector<Vec3f> colour_of_vertex{};  ///< Linear; empty: the scene's own.
  std::optional<Skin> skin{};
  std::optional<Tubes> tubes{};
  Vec3 tube_colour = Vec3::Zero();
};

/// What is known of some rows of a picture before their pixels are made.
struct SceneBand {
  int first_row = 0;
  std::vector<double> outlines{};      ///< Coverage of each pixel; empty if the style has none.
  std::vector<SurfaceProbe> probes{};  ///< Of each pixel's middle; empty without occlusion rays.
};

/// Everything to be drawn, in one unit frame: a surface, once or in several coats. The rays of all
/// coats are the same, so that further coats cost little. Immutable after construction; pixels may
/// be asked for from many threads at once.
class Scene {
 public:
  /// \pre at least one paint; with materials, only one.
  /// \throw InvalidInput, Cancelled
  Scene(const TriMesh& mesh, const Camera& camera, std::span<const Paint> paints,
        const RenderOptions& options, const RunContext& run);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Prepares some rows. \throw Cancelled
  [[nodiscard]] SceneBand band(int first_row, int rows, const RunContext& run) const;

  /// Light and opacity of a pixel of a band for every coat: the colour is not multiplied by the
  /// opacity. \param lights one a coat.
  void pixel(int x, int y, const SceneBand& band, std::span<Light> lights) const;

 private:
  /// A place of the surface that is seen.
  struct Place {
    Vec3 position = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();       ///< As shaded, on the viewer's side.
    Vec3 face_normal = Vec3::UnitZ();  ///< Of the flat face, on the viewer's side.
  };

  /// A sample of the picture, and what all coats have in common there, once it is known.
  struct Sample {
    PictureRay ray{};
    int x = 0;
    int y = 0;
    std::size_t index = 0;  ///< In the pixel's pattern.
    const SceneBand* band = nullptr;
    RayHit hit{};
    double crease_t = 0.0;
    std::optional<SurfacePoint> surface{};  ///< At the hit; its albedo is a coat's.
  };

  void add_coat(const Paint& paint, const UnitFrame& frame);
  void add_lines(double reach, const RunContext& run);
  [[nodiscard]] Light light_of(const Coat& coat, Sample& sample) const;
  [[nodiscard]] Place place_of(const PictureRay& ray, const RayHit& hit) const;
  [[nodiscard]] SurfaceProbe probe(int x, int y) const;
  [[nodiscard]] double openness(const Place& place, int x, int y, std::size_t index,
                                const SceneBand& band) const;
  [[nodiscard]] std::size_t band_index(int x, int y, const SceneBand& band) const;
  [[nodiscard]] double shadow(const PictureRay& ray, double t, int x, int y) const;
  [[nodiscard]] RayHit nearest(const PictureRay& ray, int x, int y) const;
  [[nodiscard]] Vec3 to_camera(const Vec3& vector) const;
  [[nodiscard]] Skin::Shown shown_at(const Coat& coat, const RayHit& hit) const;
  [[nodiscard]] SurfacePoint surface_at(const Sample& sample, const RayHit& hit) const;
  [[nodiscard]] Light surface_light(const Coat& coat, Sample& sample, const RayHit& hit,
                                    bool before_tube) const;
  [[nodiscard]] Vec3 background(int y) const;

  RenderOptions options_;
  TriMesh mesh_;
  std::vector<std::array<Vec3f, 3>> normals_{};
  Vec3 colour_;
  double pixel_ = 0.0;  // size of a pixel at the middle of the scene
  std::vector<std::array<double, 2>> pattern_;
  std::optional<RayScene> surface_{};
  std::optional<TileMask> mask_{};
  std::optional<PictureRays> rays_{};
  std::optional<Occlusion> occlusion_{};
  std::optional<Ground> ground_{};
  std::vector<std::unique_ptr<Coat>> coats_{};
  bool has_tubes_ = false;
  std::optional<Tubes> creases_{};
  std::optional<Contours> contours_{};
};

}  // namespace vantage
