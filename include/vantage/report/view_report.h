// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/render/render.h"

/// \file
/// report.html: one self-contained page to explore a result in. docs/report.md describes it,
/// viewer/README.md its data block.
/// Pictures of an analysed shape.

namespace vantage {

/// What a picture of a view shows.
enum class Picture { Plain, Map, Skeleton };

/// Takes a picture with `camera`. \throw InvalidInput if the map or skeleton to show is not there
/// \throw Cancelled
/// \param background unset: transparent.
Image take_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, const std::optional<Rgb8>& background = {},
                   const RunContext& run = {});

/// Takes a picture with any look; its size is that of `options`. \throw InvalidInput likewise, Cancelled
/// \param asset what the shape was made from: a plain picture shows it in its own colours and
/// materials; null for clay.
Image draw_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, RenderOptions look, const RunContext& run = {},
                   const Model* asset = nullptr);

/// The same in 16 bit a channel. \throw Cancelled
DeepImage draw_picture_deep(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                            const ViewOptions& options, RenderOptions look,
                            const RunContext& run = {}, const Model* asset = nullptr);

/// How all pictures of a shape look.
struct PictureLook {
  /// Quality::Normal. The size is not looked at.
  PictureLook() { set_quality(render, Quality::Normal); }

  explicit PictureLook(const RenderOptions& options, const Model* its_asset = nullptr)
      : render(options), asset(its_asset) {}

  /// The same on that background if it has none.
  [[nodiscard]] PictureLook on(const Rgb8& background) const;

  RenderOptions render{};
  /// What the shape was made from: plain pictures show its own colours and materials if it has any;
  /// null: clay.
  const Model* asset = nullptr;
};

/// Pictures of a shape's surface, from any number of cameras: its search tree and normals are made
/// once, when the first picture is taken. Not for several threads at once.
class ShapePictures {
 public:
  /// \param shape must outlive this, with its surface as it is; so must the look's asset.
  explicit ShapePictures(const ShapeAnalysis& shape, const PictureLook& look = {});

  /// Pictures with one camera, hardly slower than one. \param background unset: the look's.
  /// \throw InvalidInput, Cancelled
  std::vector<Image> take(const Camera& camera, std::span<const Picture> pictures,
                          const ViewOptions& options, const std::optional<Rgb8>& background = {},
                          const RunContext& run = {});

  /// A plain picture of another size: the one that was taken last with this camera, made smaller, if
  /// it has that aspect. \throw InvalidInput, Cancelled
  Image take_small(const Camera& camera, int width, int height, const ViewOptions& options,
                   const RunContext& run = {});

  /// A plain one with any look, of the look's size.
  Image take_plain(const Camera& camera, const RenderOptions& look, const RunContext& run = {});

  /// How they look.
  [[nodiscard]] const PictureLook& look() const { return look_; }

 private:
  const PictureSurface& surface(const RunContext& run);
  void keep_plain(const Camera& camera, const Image& image);
  const PictureSurface& asset_surface(const RunContext& run);

  const ShapeAnalysis* shape_;
  PictureLook look_{};  // without an asset that has no look of its own
  std::shared_ptr<const struct CloudPicture> cloud_{};  // in place of a cloud's surface
  std::vector<Rgb8> point_colours_{};                   // of its vertices, if it has any
  std::optional<PictureSurface> surface_{};
  std::vector<std::pair<Camera, Image>> plain_{};  ///< What take() took, for take_small().
  std::optional<PictureSurface> asset_surface_{};  // the file's own faces, with their materials
};

/// PNG files of several pictures, side by side. \throw Cancelled
std::vector<std::string> png_files(std::span<const Image> images, const RunContext& run = {});

/// Whether this build has the page: it is bundled by npm when the library is built.
bool has_report_page();

/// The page: the model in 3D with its significance, skeleton and contraction, the view sphere as a
/// heat map, the views with their cameras, the paper's search to replay. Models past 300 000 faces
/// are simplified for display, which the page says; the numbers are those of the whole model. The
/// scores on the sphere and in the replay are estimates, which meet the exact ones at the highest and
/// the worst score; of up to about 2000 vertices they are exact.
/// \pre the map is there. \throw InvalidInput if !has_report_page(). \throw Cancelled
/// \complexity about a thousand estimates, then about 30 bytes a face.
std::string report_html(const Model& model, const ShapeAnalysis& shape, ShapePictures& pictures,
                        const ViewReport& report, const ViewOptions& options,
                        const RunContext& run = {});

/// All that the reader, the steps and the search had to say, one sentence each.
std::vector<std::string> warnings_of(const Model& model, const ShapeAnalysis& shape,
                                     const ViewReport& report);

/// view.json: the same bytes for the same input, options and version.
/// \param seconds adds the times, for `--json`; null for the file.
std::string view_json(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
                      const ViewOptions& options, const StageSeconds* seconds = nullptr);

/// timings.json: the stage seconds alone.
std::string timings_json(const StageSeconds& seconds);

/// The search's evaluated directions as CSV: goal,step,level,dx,dy,dz,score.
std::string trace_csv(const ViewReport& report);

}  // namespace vantage
