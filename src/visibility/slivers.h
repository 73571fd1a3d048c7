// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

#include "spatial/ray_scene.h"
#include "visibility/site_picture.h"
#include "visibility/surface.h"
#include "visibility/surface_edges.h"

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
  std::vector<Vec3> halves{};           ///< From there to one end of the part with one answer.
  std::vector<std::uint8_t> seen{};     ///< Of each place; for others to fill in.
};

/// Immutable after construction.
class SliverSearch {
 public:
  /// Finds where edges pass through faces. \param surface, edges must outlive this. \param scene the
  /// surface's faces. \param backs hiding_backs().
  SliverSearch(const Surface& surface, const SurfaceEdges& edges, const CandidateScene& scene,
               std::span<const std::uint8_t> backs);

  /// What is asked, one entry a face.
  struct Asked {
    std::span<const std::uint8_t>
        turned{};  ///< The side turned to the eye: 1 front, 2 back, 0 neither.
    std::span<const std::uint8_t> wanted{};     ///< 1 for those to be looked for, else 0.
    std::span<const std::uint32_t> contours{};  ///< Edges that may end what is seen behind them.
  };

  /// One place for each part of the edges of the wanted faces that may be seen for itself.
  /// \pre picture.is_whole.
  [[nodiscard]] EdgePlaces places(const Viewpoint& eye, const SitePicture& picture,
                                  const Asked& asked) const;

  /// 1 for each face that others pass through, or that passes through others; else 0.
  [[nodiscard]] std::span<const std::uint8_t> crossed() const { return crossed_; }

  /// Whether the surface turns away past an edge. \param turned as above.
  [[nodiscard]] bool is_contour(std::size_t edge, std::span<const std::uint8_t> turned) const;

 private:
  struct Contour;
  class Contours;

  std::size_t add_crossings(std::size_t edge, const Viewpoint& eye, const SitePicture& picture,
                            const Contours& contours, std::vector<double>& cuts) const;
  void add_places(std::size_t edge, const Viewpoint& eye, const Asked& asked,
                  std::vector<double>& cuts, EdgePlaces& result) const;

  void find_pierced(const CandidateScene& scene);

  const Surface& surface_;
  const SurfaceEdges& edges_;
  std::vector<std::size_t> first_pierced_{0};  // of each edge in pierced_, and one past the last
  std::vector<double> pierced_{};              // share of the way along the edge
  std::vector<std::uint8_t> crossed_;          // of each face
};

}  // namespace vantage
