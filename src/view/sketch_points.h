// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

#include "view/sketch_coordinates.h"

namespace vantage {

/// Points that stand for vertices in a sketch, those of about one normal side by side: most runs of
/// them are wholly turned away from an eye, or wholly towards it.
struct SketchPoints {
  /// Normals of the faces at a point are gathered in so many cones; most vertices have six faces.
  static constexpr std::size_t kCones = 8;

  std::vector<float> weight{};   ///< What a point adds to the score, one entry a point.
  SketchCoordinates position{};  ///< Padded, like the cones.
  std::array<SketchPlanes, kCones> cones{};
  /// One cone around all of a point's: an eye that does not see into it sees into none of them.
  SketchPlanes hull{};
};

/// Takes at most `count` vertices, spread over the surface in proportion to their significance.
/// \param order all vertices, along a curve through space.
SketchPoints sketch_points(const TriMesh& surface, std::span<const std::uint32_t> order,
                           const std::vector<FaceSides>& sides,
                           std::span<const double> significance, const ScoringCamera& camera,
                           std::size_t count);

}  // namespace vantage
