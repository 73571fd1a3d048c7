// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/render/render.h"

/// \file
/// Pictures of an analysed shape.

namespace vantage {

/// What a picture of a view shows.
enum class Picture { Plain, Map, Skeleton };

/// Takes a picture with `camera`. \throw Cancelled
/// \param background unset: transparent.
Image take_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, const std::optional<Rgb8>& background = {},
                   const RunContext& run = {});

/// Takes a picture with any look; its size is that of `options`. \throw Cancelled
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
  /// it has that shape. \throw InvalidInput, Cancelled
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
  std::optional<PictureSurface> surface_{};
  std::vector<std::pair<Camera, Image>> plain_{};  ///< What take() took, for take_small().
  std::optional<PictureSurface> asset_surface_{};  // the file's own faces, with their materials
};

/// PNG files of several pictures, side by side. \throw Cancelled
std::vector<std::string> png_files(std::span<const Image> images, const RunContext& run = {});

}  // namespace vantage
