// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/fields.h"
#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Pictures by ray casting on the CPU: no display, no GL, the same pixels for any thread count.
/// Where a picture's camera looks, which way is up in it, and how wide it sees.

namespace vantage {

class DrawnSurface;

/// How much work goes into a picture.
enum class Quality {
  Draft,   ///< 9 samples a pixel, 8 occlusion rays a probe: thumbnails.
  Normal,  ///< 16 and 8: pictures on a screen.
  Fine,    ///< 64 and 64: print.
};

/// How surfaces look.
enum class Style {
  Clay,       ///< Matt, softly lit from the viewer's left.
  Asset,      ///< The same in the colours and materials of the file, where these are at hand.
  Technical,  ///< A shaded drawing: outlines and sharp edges as lines, hidden ones left out.
};

/// What is drawn and how.
struct RenderOptions {
  int width = 800;   ///< px; the program's pictures: of ViewOptions.
  int height = 600;  ///< px; as `width`.
  /// Rays per pixel where edges, outlines or textures need them, rounded up to a square; elsewhere
  /// four tell that they do not.
  int samples = 16;
  int ambient_rays = 0;  ///< Occlusion rays of every second pixel both ways; 0: no occlusion.
  std::optional<Rgb8> background{};  ///< Unset: transparent.
  /// The background turns to this colour towards the bottom. Looked at if `background` is set.
  std::optional<Rgb8> background_bottom{};
  Rgb8 colour{{196, 192, 186}};  ///< Of the surface where no vertex colours are given.
  Style style = Style::Asset;    ///< How it looks.
  double crease_deg = 40.0;  ///< Edges that bend by more are sharp, softly over ± 10°; 0: facets.
  bool ground = false;       ///< A soft shadow on a level ground that touches the model.
  Vec3 up = Vec3::UnitY();   ///< Of the ground; of any length but 0.
};

/// Names of Quality.
inline constexpr const char* kQualityWords = "draft|normal|fine";
/// Sets the numbers of rays.
void set_quality(RenderOptions& options, Quality quality);
/// The same from "draft", "normal" or "fine". \throw InvalidInput
void set_quality_word(RenderOptions& options, std::string_view word);
/// The word of the numbers of rays; empty if they are those of none.
std::string quality_word(const RenderOptions& options);

/// Sets the background from a word: "transparent", "gradient", "white", "black", "#rrggbb", or two
/// of these colours as "TOP:BOTTOM".
/// \throw InvalidInput for any other text; `options` are then as they were.
void set_background(RenderOptions& options, std::string_view text);
/// "transparent", "#rrggbb" or "#rrggbb:#rrggbb".
std::string background_text(const RenderOptions& options);

/// The table of RenderOptions.
inline constexpr auto kRenderFields = std::tuple{
    Text{"quality", set_quality_word, quality_word, "rays spent on each pixel", TextForm::Plain,
         kQualityWords},
    Field{"samples", &RenderOptions::samples, 1, 1024, kNoFlag},
    Field{"ambient-rays", &RenderOptions::ambient_rays, 0, 1024, kNoFlag},
    Text{"background", set_background, background_text,
         "transparent, gradient, white, black, #rgb, #rrggbb, or two of these colours as "
         "TOP:BOTTOM"},
    Choice{"style", &RenderOptions::style, "clay|asset|technical",
           "clay: matt and softly lit; asset: the same in the file's own colours and materials; "
           "technical: a drawing with outlines and sharp edges"},
    Switch{"ground", &RenderOptions::ground, "a soft shadow on the ground under the model"},
    Field{"crease", &RenderOptions::crease_deg, 0.0, 80.0,
          "edges that bend by more are sharp, 0: facets", "degrees"},
};

/// A curve drawn as tubes through the surface, which then becomes translucent.
struct TubeOverlay {
  const CurveGraph* graph = nullptr;  ///< Null draws none.
  double radius = 0.0;                ///< Of tubes, model units; joints are 1.6 times as thick.
  Rgb8 colour{{200, 30, 40}};         ///< sRGB.
};

/// Renders `mesh` from `camera`.
/// \param vertex_colours |V| colours, or empty for `options.colour`.
/// \throw InvalidInput, Cancelled
Image render(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours = {},
             const TubeOverlay& overlay = {}, const RenderOptions& options = {},
             const RunContext& run = {});

/// What a surface is coloured by, and what is drawn through it.
struct Paint {
  std::span<const Rgb8> vertex_colours{};  ///< |V|, or empty.
  TubeOverlay overlay{};                   ///< Curves through the surface.
  /// Materials of the mesh; null or none at all: `options.colour`. Times the vertices' colours.
  const Appearance* appearance = nullptr;
  /// |V| values of a map, or empty: coloured as colour_map() does, but mixed within a face before they
  /// are, so that no face has a colour that the scale does not. In place of all other colours.
  std::span<const double> vertex_values{};
};

/// Renders `mesh` from `camera`. \throw InvalidInput, Cancelled
Image render_painted(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                     const RenderOptions& options = {}, const RunContext& run = {});

/// A surface made ready to be drawn: its search tree, normals and materials. Pictures of it, from
/// whatever camera and in whatever paint, then cost their rays alone.
class PictureSurface {
 public:
  /// \param appearance its materials; null for none; must outlive this.
  /// \param crease_deg as in RenderOptions, whose value is not looked at again.
  /// \throw InvalidInput if there is nothing to draw; Cancelled
  explicit PictureSurface(const TriMesh& mesh, const Appearance* appearance = nullptr,
                          double crease_deg = RenderOptions{}.crease_deg,
                          const RunContext& run = {});
  ~PictureSurface();
  PictureSurface(PictureSurface&&) noexcept;
  PictureSurface& operator=(PictureSurface&&) noexcept;

  /// Pictures from one camera in several paints: the rays are cast once. A paint's materials are
  /// null or those of the surface; with materials there is one picture at a time.
  /// \throw InvalidInput, Cancelled
  [[nodiscard]] std::vector<Image> render(const Camera& camera, std::span<const Paint> paints,
                                          const RenderOptions& options = {},
                                          const RunContext& run = {}) const;

  /// One picture in 16 bit a channel. \throw InvalidInput, Cancelled
  [[nodiscard]] DeepImage render_deep(const Camera& camera, const Paint& paint,
                                      const RenderOptions& options = {},
                                      const RunContext& run = {}) const;

 private:
  std::unique_ptr<const DrawnSurface> surface_;
};

/// The same picture in 16 bit a channel. \throw InvalidInput, Cancelled
DeepImage render_deep(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                      const RenderOptions& options = {}, const RunContext& run = {});

/// Colour of a value in [0, 1], from cool to warm: blue, cyan, green, yellow, red. Nine control
/// colours of our own, joined linearly in OKLab (Ottosson, 2020), where equal steps look about
/// equal. Values outside are clamped; NaN is grey.
Rgb8 cool_warm(double value);

/// Colours of a map scaled linearly from its least to its largest finite value. Flat maps are all
/// cool; infinities take the colour of their end, NaN is grey.
std::vector<Rgb8> colour_map(std::span<const double> values);

/// Unit up vector for looking along −direction: the model's up axis projected to the picture.
/// Within 5° of straight up or down it turns towards a fixed horizontal axis: looking straight down
/// the model's back is at the top of the picture, looking straight up its front is. It changes
/// smoothly except, inside those 5°, for views that come from exactly behind: no field of up
/// vectors around a pole can be smooth everywhere. The model's front is +z, or −y if up is ±z.
/// \param direction to the eye. \param model_up direction of the model's up axis; both of any length but 0.
/// \throw InvalidInput
Vec3 upright(const Vec3& direction, const Vec3& model_up);

/// A camera at `eye` that shows all `points`, as large as fits, none clipped.
/// Keeps the eye; shifts the target so that the points are centred both ways, and tightens the field
/// of view until they touch the margin on two opposite sides. Up is upright() of the direction from
/// `centre` to the eye, made orthogonal to the shifted line of sight. The target lies at the depth
/// of `centre`. Orthographic: the eye is put on the line of sight, in front of all points.
/// \param points at least one, finite. \param centre what the eye was placed around; not the eye.
/// \param model_up direction. \param aspect width over height, > 0.
/// \param margin empty border as a fraction of the shorter side, in [0, 0.5).
/// \throw InvalidInput if an argument is out of range, or if the eye is so near or inside that the
///        points cannot all lie in front of it.
Camera frame_points(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                    const Vec3& model_up, double aspect, double margin = 0.04);

/// Distance from a ball's centre, in its radii, from which on frame_points() can show all of it with
/// perspective in a picture that is not narrow.
double least_distance(double margin = 0.04);

/// The aspect with which frame_points() lets the points touch the margin on all four sides: width
/// over height of their box and the margin. 0 and infinity are possible, if they lie in a line; 1 if
/// they are one point. \throw InvalidInput like frame_points()
double fitting_aspect(std::span<const Vec3> points, const Viewpoint& eye, const Vec3& centre,
                      const Vec3& model_up, double margin = 0.04);

}  // namespace vantage
