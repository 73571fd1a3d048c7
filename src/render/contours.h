// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "vantage/core/run_context.h"

#include "render/picture_rays.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// Lines where the surface ends or one part of it hides another, as wide in the picture everywhere.
class Contours {
 public:
  /// \param scene and \param rays must outlive this. \param side samples across a pixel.
  /// \param line_px width of the lines. \param least_jump least step in depth that gets a line.
  Contours(const RayScene& scene, const PictureRays& rays, int width, int side, double line_px,
           double least_jump);

  /// Whether the surface may break in a pixel or between it and those beside it.
  using MayBreak = std::function<bool(int x, int y)>;

  /// How much of each pixel of some rows is covered by lines, in [0, 1]; row by row.
  /// \param may_break is asked about pixels beyond the rows and beyond the picture, too; rays are
  /// cast where it is true, and a pixel beside. \throw Cancelled
  [[nodiscard]] std::vector<double> coverage(int first_row, int rows, const MayBreak& may_break,
                                             const RunContext& run) const;

 private:
  [[nodiscard]] double depth(int x, int y) const;

  const RayScene* scene_;
  const PictureRays* rays_;
  int width_;
  int side_;
  double radius_;  // of a line, in samples
  double least_jump_;
};

}  // namespace vantage
