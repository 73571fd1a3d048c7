// SPDX-License-Identifier: MIT
#pragma once

#include <array>
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
  std::vector<std::uint8_t> seen{};     ///< Of each place; for others to fill in.
};

/// Immutable after construction.
class SliverSearch {
 public:
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
  /// The faces at an edge: two that run along it in opposite ways, two that run the same way, or
  /// not two.
  enum class Pair : std::uint8_t { Opposite, Same, None };
  struct Picture;
  struct Contour;
  class Contours;

  [[nodiscard]] Pair pair_at(std::size_t edge) const;
  [[nodiscard]] bool is_contour(std::size_t edge, std::span<const std::uint8_t> turned) const;
  void add_crossings(std::size_t edge, const Viewpoint& eye, const Picture& picture,
                     const Contours& contours, std::vector<double>& cuts) const;
  void add_places(std::size_t edge, const Viewpoint& eye, const Asked& asked,
                  std::vector<double>& cuts, EdgePlaces& result) const;

  const Surface* surface_;
  EdgeTable table_;
  std::vector<Pair> pairs_{};                           // of each edge
  std::vector<std::array<std::uint32_t, 2>> beside_{};  // first and last face at each edge
  std::vector<std::array<std::uint32_t, 3>> edges_of_face_{};
  std::vector<std::size_t> first_pierced_{0};  // of each edge in pierced_, and one past the last
  std::vector<double> pierced_{};              // share of the way along the edge
};

}  // namespace vantage
