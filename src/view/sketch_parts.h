// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/scoring.h"

/// \file
/// What a sketch of a model is made of. Coordinates are those of the unit sphere that the scoring
/// camera's sphere becomes.

namespace vantage {

/// Numbers worked on at a time where registers are wide: lists that they are read from are longer by
/// as many, or a multiple.
inline constexpr unsigned kWideLanes = 8;

/// Coordinates of points, one array an axis, so that eight at a time can be worked on.
struct SketchCoordinates {
  std::vector<float> x{}, y{}, z{};
};

/// Points that stand for vertices.
struct SketchPoints {
  /// Normals of the faces at a point are gathered in so many cones; most vertices have six faces.
  static constexpr std::size_t kCones = 8;

  /// Axes of cones and how far the eye must rise over the plane across them to see into them.
  struct Cones {
    SketchCoordinates axis{};
    std::vector<float> offset{};
  };

  std::vector<float> weight{};   ///< What a point adds to the score, one entry a point.
  SketchCoordinates position{};  ///< Padded to whole eights and more, like the cones.
  std::array<Cones, kCones> cones{};
  /// One cone around all of a point's: an eye that does not see into it sees into none of them.
  Cones hull{};
};

/// A coarse surface that hides them.
struct SketchSurface {
  SketchCoordinates corners{};  ///< Padded to whole eights.
  std::vector<Triangle> faces{};
  std::vector<std::uint8_t> two_sided{};  ///< One per face.
  std::vector<std::uint32_t> order{};     ///< All vertices of the whole surface, along a curve.
};

/// Takes at most `count` vertices, spread over the surface in proportion to their significance.
/// \param order of sketch_surface().
SketchPoints sketch_points(const TriMesh& surface, std::span<const std::uint32_t> order,
                           const std::vector<FaceSides>& sides,
                           std::span<const double> significance, const ScoringCamera& camera,
                           std::size_t count);

/// The surface, or one of about `count` faces if it has more. \param sphere the scoring camera's.
SketchSurface sketch_surface(const TriMesh& surface, const std::vector<FaceSides>& sides,
                             const Sphere& sphere, std::size_t count);

}  // namespace vantage
