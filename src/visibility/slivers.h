// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/topology.h"

#include "visibility/surface.h"

/// \file
/// Faces that no sample sees and of which a sliver may be in view all the same. Along an edge
/// what is hidden begins and ends where the edge passes behind a contour, an edge past which the
/// surface turns away from the eye, or through a face (Appel, "The notion of quantitative
/// invisibility and the machine rendering of solids", 1967). Between two such places one answer
/// holds for all of the edge.

namespace vantage {

/// Places on edges, to be asked about.
struct EdgePlaces {
  std::vector<Vec3> places{};           ///< In the surface's frame.
  std::vector<std::uint32_t> owner{};   ///< A face at the edge, in view beside a place that is.
  std::vector<std::uint32_t> also{};    ///< The other face at the edge, or the same.
  std::vector<std::uint8_t> of_both{};  ///< 1 where that one is in view as well.
  std::vector<double> lengths{};        ///< Of the edge's part with one answer, in the frame.
};

/// Immutable after construction.
class SliverSearch {
 public:
  /// The work grows with the square of the number of faces, and what a face weighs falls: beyond so
  /// many it is not worth it. [ours, by measurement]
  static constexpr std::size_t kMostFaces = 4000;

  /// Finds where edges pass through faces. \param surface must outlive this.
  explicit SliverSearch(const Surface& surface);

  /// What is asked, one entry a face.
  struct Asked {
    std::span<const std::uint8_t>
        turned{};  ///< The side turned to the eye: 1 front, 2 back, 0 neither.
    std::span<const std::uint8_t> wanted{};  ///< 1 for those to be looked for, else 0.
  };

  /// One place for each part of the edges of the wanted faces that may be seen for itself. None for
  /// an eye that has some of the surface behind it.
  [[nodiscard]] EdgePlaces places(const Viewpoint& eye, const Asked& asked) const;

 private:
  struct Picture;
  struct Contour;

  [[nodiscard]] bool is_contour(std::size_t edge, std::span<const std::uint8_t> turned) const;
  [[nodiscard]] int side_in_picture(std::size_t edge, std::uint32_t face,
                                    std::span<const std::uint8_t> turned) const;
  [[nodiscard]] std::vector<Contour> contours(const Viewpoint& eye, const Picture& picture,
                                              std::span<const std::uint8_t> turned) const;
  void add_crossings(std::size_t edge, const Viewpoint& eye, const Picture& picture,
                     std::span<const Contour> contours, std::vector<double>& cuts) const;
  void add_places(std::size_t edge, const Viewpoint& eye, const Asked& asked,
                  std::vector<double>& cuts, EdgePlaces& result) const;

  const Surface* surface_;
  EdgeTable table_;
  std::vector<std::size_t> first_pierced_{0};  // of each edge in pierced_, and one past the last
  std::vector<double> pierced_{};              // share of the way along the edge
};

}  // namespace vantage
