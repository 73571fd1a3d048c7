// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/render/render.h"

#include "render/contours.h"
#include "render/drawn_surface.h"
#include "render/fragment.h"
#include "render/ground.h"
#include "render/occlusion.h"
#include "render/openness_grid.h"
#include "render/picture_rays.h"
#include "render/prepared_paint.h"
#include "render/shading.h"
#include "render/tile_mask.h"
#include "render/tubes.h"

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

/// Light of a pixel in one paint.
struct PixelLight {
  Light light{};
  SampleNeed need = SampleNeed::One;
};

/// What is known of some rows of a picture before their pixels are made.
struct SceneBand {
  FragmentRows rows;
  int first_row = 0;                       ///< Of the band; `rows` begin before it.
  std::optional<OpennessGrid> openness{};  ///< Nothing without occlusion rays.
  std::vector<double> outlines{};          ///< Coverage of each pixel; empty if there are none.
};

/// A surface seen by a camera, in one paint or several, with all else that is drawn: the rays of all
/// paints are the same. One sample of each pixel and of those around it tells how many more it needs.
/// Immutable after construction; pixels may be asked for from many threads at once.
class Scene {
 public:
  /// \param surface must outlive this. \pre at least one paint; with materials, only one.
  /// \throw InvalidInput, Cancelled
  Scene(const DrawnSurface& surface, const Camera& camera, std::span<const Paint> paints,
        const RenderOptions& options, const RunContext& run);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Prepares some rows. \throw Cancelled
  [[nodiscard]] SceneBand band(int first_row, int rows, const RunContext& run) const;

  /// Light and opacity of a pixel of a band for every paint: the colour is not multiplied by the
  /// opacity. \param lights one a paint.
  void pixel(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const;

 private:
  /// A sample of the picture, and what all paints have in common there, once it is known.
  struct Sample {
    PictureRay ray{};
    int x = 0;
    int y = 0;
    std::size_t index = 0;  ///< In the pixel's pattern.
    const SceneBand* band = nullptr;
    RayHit hit{};
    bool on_line = false;                ///< A feature line lies before the surface.
    std::optional<std::size_t> patch{};  ///< Of its pixel, that the hit lies on.
  };

  /// A patch of the surface that several samples of a pixel meet: they are lit alike.
  struct Patch {
    SurfacePlace place{};                         ///< Where the first of them meets it.
    SurfacePoint point{};                         ///< There, with the albedo that was shaded last.
    std::optional<Vec3> shown{};                  ///< What that looks like.
    bool is_of_paint = false;                     ///< It was shaded for the paint at hand.
    std::array<std::optional<double>, 2> veil{};  ///< Opacity around tubes: none before it, or one.
  };

  using Patches = std::vector<Patch>;

  using Pattern = std::vector<std::array<double, 2>>;
  using SamplePacket = std::array<Sample, 4>;
  /// Samples that tell whether a pixel with bends or colours needs all. [ours]
  static constexpr int kFewSamples = 4;

  void add_lines(const RunContext& run);
  /// A sample at the middle of a pixel, moved by so many pixels.
  [[nodiscard]] Sample aimed(int x, int y, double right, double down) const;
  /// Finds what the first `count` samples show. \param width of their rays.
  void trace(SamplePacket& samples, std::size_t count, double width) const;

  [[nodiscard]] bool may_show_anything(int x, int y) const;
  void make_fragments(int y, FragmentRows& rows) const;
  /// Whether something that their middles do not show lies beside them.
  void find_breaks(const SamplePacket& middles, std::size_t count, FragmentRows& rows) const;
  [[nodiscard]] PaintFragment paint_fragment(const PreparedPaint& paint,
                                             const Sample& sample) const;
  /// What all paints have in common at a pixel that shows the surface and needs one sample.
  [[nodiscard]] SurfacePoint plain_point(int x, int y, const SceneBand& band) const;
  [[nodiscard]] Light plain_light(int x, int y, std::size_t paint, const SceneBand& band,
                                  std::optional<SurfacePoint>& point) const;
  /// Looks at a few samples where they are enough; else the need becomes all.
  void look_at_few(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const;
  void look_at_all(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const;

  /// Finds the patches of all samples, whatever the paints.
  void find_patches(SamplePacket& samples, std::size_t count, Patches& patches) const;
  static void begin_paint(Patches& patches);
  /// Light of the first `count` samples, through all layers that let some pass.
  /// \param patches of the pixel, so far.
  [[nodiscard]] std::array<Light, 4> lights_of(const PreparedPaint& paint, SamplePacket& samples,
                                               std::size_t count, Patches& patches) const;
  [[nodiscard]] Light surface_light(const PreparedPaint& paint, Sample& sample, const RayHit& hit,
                                    bool before_tube, Patches& patches) const;
  [[nodiscard]] std::size_t patch_at(const Sample& sample, const RayHit& hit,
                                     Patches& patches) const;
  [[nodiscard]] SurfacePoint point_at(const SurfacePlace& place, const Vec3& ray_direction,
                                      double openness) const;
  [[nodiscard]] Vec3 shaded(const SurfacePoint& point) const;
  [[nodiscard]] float probed(const SurfacePlace& place, std::span<const Vec3f> directions) const;
  void add_tube_and_ground(Light& light, const PreparedPaint& paint, const Sample& sample,
                           const TubeHit& tube) const;
  void add_ground(Light& light, const PictureRay& ray, int x, int y) const;
  [[nodiscard]] double shadow(const PictureRay& ray, double t, int x, int y) const;
  [[nodiscard]] Vec3 to_camera(const Vec3& vector) const;
  [[nodiscard]] Vec3 background(int y) const;

  const DrawnSurface* surface_;
  RenderOptions options_;
  double pixel_ = 0.0;  // size of a pixel at the middle of the scene
  Pattern few_;
  Pattern pattern_;
  std::optional<TileMask> mask_{};
  std::optional<PictureRays> rays_{};
  std::optional<Occlusion> occlusion_{};
  std::optional<HemisphereDirections> probe_directions_{};
  std::optional<HemisphereDirections> sample_directions_{};
  std::optional<Ground> ground_{};
  std::vector<PreparedPaint> paints_{};
  std::optional<Tubes> creases_{};
  std::optional<Contours> contours_{};
};

}  // namespace vantage
