// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "view/sketch_frame.h"
#include "view/sketch_surface.h"

namespace vantage {

/// The depth buffer of a sketch: the coarse surface, drawn from one eye after the other.
class SketchPicture {
 public:
  /// Nearness over the picture: along_x · x + along_y · y + offset, x and y in cells.
  struct Plane {
    float along_x, along_y, offset;
  };

  /// \param surface is kept, not copied. \param cells of the picture, along each side.
  SketchPicture(const SketchSurface& surface, std::size_t cells);

  void draw(const SketchFrame& frame);

  [[nodiscard]] std::size_t cells() const { return cells_; }

  /// The nearness at the middle of each cell, row by row; the lowest number where there is nothing.
  [[nodiscard]] const float* nearness() const { return nearness_.data(); }

  /// Of the face seen at the middle of a cell, one with something.
  [[nodiscard]] const Plane& plane_at(std::size_t cell) const {
    return planes_[static_cast<std::size_t>(face_at_[cell])];
  }

 private:
  template <unsigned Lanes>
  struct Outlines;

  template <unsigned Lanes>
  void draw_faces(const SketchFrame& frame);
#if defined(__x86_64__)
  void draw_faces_wide(const SketchFrame& frame);
#endif
  template <unsigned Lanes>
  void outline(std::size_t first, const SketchFrame& frame, const IntsOf<Lanes>& may_show,
               Outlines<Lanes>& outlines) const;
  template <unsigned Lanes>
  void draw_face(std::size_t face, const Outlines<Lanes>& outlines, unsigned lane);

  const SketchSurface& surface_;
  std::size_t cells_;
  std::vector<float> nearness_;        // with a row and some lanes to spare
  std::vector<std::int32_t> face_at_;  // the face seen there, a zero where none ever was
  std::vector<Plane> planes_;          // of each face drawn
};

}  // namespace vantage
