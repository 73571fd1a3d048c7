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

/// Pictures of a shape's surface in clay, from any number of cameras: its search tree and normals
/// are made once, when the first picture is taken. Not for several threads at once.
class ShapePictures {
 public:
  /// \param shape must outlive this, with its surface as it is.
  explicit ShapePictures(const ShapeAnalysis& shape) : shape_(&shape) {}

  /// Pictures with one camera, hardly slower than one. \param background unset: transparent.
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

 private:
  const PictureSurface& surface(const RunContext& run);

  const ShapeAnalysis* shape_;
  std::optional<PictureSurface> surface_{};
  std::vector<std::pair<Camera, Image>> plain_{};  ///< What take() took, for take_small().
};

/// PNG files of several pictures, side by side. \throw Cancelled
std::vector<std::string> png_files(std::span<const Image> images, const RunContext& run = {});

}  // namespace vantage
