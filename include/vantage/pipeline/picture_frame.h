// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/io/camera_files.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/pipeline/view_options.h"

/// \file
/// Camera and size of a picture of the whole surface.

namespace vantage {

struct ReportedView;

/// What a picture shows, and its size.
struct PictureFrame {
  Camera camera{};     ///< Framed on the whole surface.
  PictureSize size{};  ///< Of the picture that it is framed for.
};

/// The picture from a direction: of options.width × options.height, or, if options.fit_size, of as
/// many pixels and the aspect of what is seen, between 1:2 and 2:1. [ours]
PictureFrame frame_picture(const ShapeAnalysis& shape, const Vec3& direction, UpAxis up,
                           const ViewOptions& options);

/// A picture of about options.width × options.height pixels with that aspect (width over height),
/// no side longer than 16384.
PictureSize size_with_aspect(const ViewOptions& options, double aspect);

/// The same options for a picture of exactly that size.
ViewOptions with_size(ViewOptions options, PictureSize size);

/// A view's camera for a picture of another size: it shows all that the view's own picture does.
Camera camera_for(const ReportedView& view, PictureSize size);

}  // namespace vantage
