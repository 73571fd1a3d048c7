// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/camera.h"

#include "visibility/surface.h"

/// \file
/// The faces of a surface sorted by where an eye sees them: for any vertex it names the few faces
/// that may stand between it and the eye. All segments of one query end in the same eye, so a flat
/// grid in the picture plane does what a hierarchy in space would do, at a tenth of the cost.

namespace vantage {

/// A pyramid of grids over the picture plane. A face lies in the level whose cells are about its
/// size, in at most a few cells, so memory is O(|F|) whatever the shapes. Made for reuse: rebuilding
/// it for another eye allocates nothing new.
class EyeGrid {
 public:
  /// Sorts the faces for an eye given in the surface's frame. \return false, without a usable
  /// grid, if some site is not well in front of the eye.
  bool build(const Surface& surface, const Viewpoint& eye);

  /// Number of faces to look at for one site.
  [[nodiscard]] std::size_t candidate_count(std::uint32_t site) const;

  /// Asks decide(face) about the candidates of a site until one answers true: every face whose
  /// projection may hold the site's and that may be nearer to the eye.
  template <class Decide>
  [[nodiscard]] bool any(std::uint32_t site, const Decide& decide) const {
    const Spot spot = spots_[site];
    const auto x = static_cast<std::uint32_t>(spot.x);
    const auto y = static_cast<std::uint32_t>(spot.y);
    for (std::uint32_t levels = used_levels_; levels != 0; levels &= levels - 1) {
      const std::size_t cell = cell_of(static_cast<unsigned>(std::countr_zero(levels)), x, y);
      for (std::uint32_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i) {
        const std::uint32_t face = faces_[i];
        const Outline& o = outlines_[face];
        const bool near = (o.depth <= spot.depth) & (o.x_low <= spot.x) & (spot.x <= o.x_high) &
                          (o.y_low <= spot.y) & (spot.y <= o.y_high);
        if (near && decide(face)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  /// A site in the picture: x, y in finest cells, depth 0 (nearest) to 1.
  struct Spot {
    float x, y, depth;
  };

  /// What a face covers in the picture, rounded outwards, and its nearest depth.
  struct Outline {
    float x_low, x_high, y_low, y_high, depth;
  };

  /// The cells of one level that a face lies in.
  struct Cover {
    std::uint16_t x_low, y_low;
    std::uint8_t columns, rows, level;
  };

  bool project(const Surface& surface, const Viewpoint& eye);
  void choose_resolution(std::size_t face_count);
  [[nodiscard]] Outline outline(const Triangle& face) const;
  [[nodiscard]] Cover cover(const Outline& outline) const;
  void count_cells(const Surface& surface);
  void fill_cells();

  [[nodiscard]] std::size_t cell_of(unsigned level, std::uint32_t x, std::uint32_t y) const {
    return level_begin_[level] + ((y >> level) << (bits_ - level)) + (x >> level);
  }

  unsigned bits_ = 0;                           // the finest level has 2^bits × 2^bits cells
  std::uint32_t used_levels_ = 0;               // bit l: some face lies in level l
  std::vector<std::size_t> level_begin_{};      // first cell of each level
  std::vector<Spot> spots_{};                   // of each site
  std::vector<std::array<double, 3>> plane_{};  // x, y, depth of each site before scaling
  std::vector<Outline> outlines_{};             // of each face
  std::vector<Cover> covers_{};                 // of each face
  std::vector<std::uint32_t> cell_begin_{};     // where each cell begins in faces_
  std::vector<std::uint32_t> faces_{};          // faces of all cells, one cell after the other
};

}  // namespace vantage
