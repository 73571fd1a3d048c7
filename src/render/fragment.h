// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "render/drawn_surface.h"

namespace vantage {

/// What the middle of a pixel shows of the surface.
struct Fragment {
  SurfacePlace place{};
  bool hit = false;
  bool line = false;    ///< A feature line.
  bool breaks = false;  ///< Something else shows beside the middle: it may be thinner than a pixel.
};

/// What it shows of one paint.
struct PaintFragment {
  Vec3f albedo = Vec3f::Zero();    ///< Linear.
  Vec3f emission = Vec3f::Zero();  ///< Linear; added to what it reflects.
  bool opaque = false;             ///< A lit surface that nothing shines through.
  bool tube = false;
};

/// How many samples a pixel needs in one paint.
enum class SampleNeed {
  One,  ///< It and those around it show one patch of the surface in one colour, or nothing at all.
  Few,  ///< One patch, but bent or coloured: unless a few samples differ much, their mean will do.
  All,  ///< The surface, a line or a tube ends there or steps back.
};

/// Whether two places belong to one patch of the surface: alike in normal (up to about 26°), and
/// near each other's plane. \param tolerance distance from the plane that is still near.
inline bool same_patch(const SurfacePlace& a, const SurfacePlace& b, float tolerance) {
  constexpr float kAlike = 0.9F;  // [ours]
  return a.normal.dot(b.normal) > kAlike &&
         std::abs(a.normal.dot(b.position - a.position)) <= tolerance;
}

/// Differences between colours count over their brightness, at least this. [ours]
inline constexpr float kDarkestColour = 0.05F;

/// Fragments of whole rows of a picture, and of the rows beside them that take part in their pixels.
struct FragmentRows {
  int width = 0;
  int first_row = 0;
  int rows = 0;
  std::size_t paints = 0;
  std::vector<Fragment> fragments{};
  std::vector<PaintFragment> of_paints{};  ///< Paints of a pixel side by side.

  FragmentRows(int picture_width, int first, int count, std::size_t paint_count)
      : width(picture_width), first_row(first), rows(count), paints(paint_count) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
    fragments.resize(pixels);
    of_paints.resize(paints * pixels);
  }

  [[nodiscard]] bool has(int x, int y) const {
    return x >= 0 && x < width && y >= first_row && y < first_row + rows;
  }

  /// By what the surface is like at a pixel and beside it. \param pixel size at the surface.
  [[nodiscard]] SampleNeed need(int x, int y, float pixel) const;
  /// The same for a paint. \param of_surface what need() says.
  [[nodiscard]] SampleNeed need_of_paint(int x, int y, std::size_t paint,
                                         SampleNeed of_surface) const;

  /// Normal, albedo and emission of a pixel that needs one sample, as the tent filter of all samples would
  /// mix them with those around it.
  /// \pre need() is one sample.
  [[nodiscard]] Vec3f mixed_normal(int x, int y) const;
  [[nodiscard]] Vec3f mixed_albedo(int x, int y, std::size_t paint) const;
  [[nodiscard]] Vec3f mixed_emission(int x, int y, std::size_t paint) const;

  /// Whether the surface may end or step back in a pixel or beside it.
  /// \param tolerance distance from a plane that is no step.
  [[nodiscard]] bool may_break(int x, int y, float tolerance) const;

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }

  [[nodiscard]] const Fragment& at(int x, int y) const { return fragments[index(x, y)]; }

  [[nodiscard]] const PaintFragment& at(int x, int y, std::size_t paint) const {
    return of_paints[index(x, y) * paints + paint];
  }
};

}  // namespace vantage
