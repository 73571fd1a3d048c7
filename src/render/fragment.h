// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "render/drawn_surface.h"

namespace vantage {

/// What the first few samples of a pixel show of the surface.
struct Fragment {
  SurfacePlace place{};  ///< Of the first hit; the normal is the mean if all are of one patch.
  bool hit = false;      ///< Some sample shows the surface.
  bool full = false;     ///< All of them do.
  bool one_patch = false;
  float off_plane = 0.0F;  ///< How far the samples lie at most from the plane of the first hit.
  bool line = false;       ///< Some sample shows a feature line.
};

/// What they show of one coat.
struct CoatFragment {
  Vec3f albedo = Vec3f::Zero();  ///< Mean, linear.
  bool even = false;             ///< All have nearly one opaque colour, and no tube.
  bool tube = false;             ///< Some sample shows a tube.
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
  std::size_t coats = 0;
  std::vector<Fragment> fragments{};
  std::vector<CoatFragment> of_coats{};  ///< Coats of a pixel side by side.

  FragmentRows(int picture_width, int first, int count, std::size_t coat_count)
      : width(picture_width), first_row(first), rows(count), coats(coat_count) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
    fragments.resize(pixels);
    of_coats.resize(coats * pixels);
  }

  [[nodiscard]] bool has(int x, int y) const {
    return x >= 0 && x < width && y >= first_row && y < first_row + rows;
  }

  /// Whether a pixel shows one patch of the surface in one colour of a coat, or nothing at all, as
  /// those beside it do: then it need not be sampled further. \param pixel size at the surface.
  [[nodiscard]] bool is_plain(int x, int y, std::size_t coat, float pixel) const;

  /// Whether the surface may end or step back in a pixel or beside it.
  /// \param tolerance distance from a plane that is no step.
  [[nodiscard]] bool may_break(int x, int y, float tolerance) const;

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }

  [[nodiscard]] const Fragment& at(int x, int y) const { return fragments[index(x, y)]; }

  [[nodiscard]] const CoatFragment& at(int x, int y, std::size_t coat) const {
    return of_coats[index(x, y) * coats + coat];
  }
};

}  // namespace vantage
