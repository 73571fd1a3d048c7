// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

namespace vantage {

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

  /// A plain one with any look, of the look's size.
  Image take_plain(const Camera& camera, const RenderOptions& look, const RunContext& run = {});

 private:
  const PictureSurface& surface(const RunContext& run);

  const ShapeAnalysis* shape_;
  std::optional<PictureSurface> surface_{};
};

/// PNG files of several pictures, side by side. \throw Cancelled
std::vector<std::string> png_files(std::span<const Image> images, const RunContext& run = {});

}  // namespace vantage
