// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

#include "view/sketch_coordinates.h"

namespace vantage {

/// The coarse surface that hides a sketch's points, its faces in an order like theirs.
struct SketchSurface {
  std::size_t face_count = 0;
  std::array<SketchCoordinates, 3> corners{};  ///< Of each face, padded like all that follows.
  SketchPlanes planes{};                       ///< Of each face.
  std::vector<std::int32_t> two_sided{};  ///< −1 for a face that hides from both sides, else 0.
  std::vector<std::uint32_t> order{};     ///< All vertices of the whole surface, along a curve.
};

/// The surface, or one of at most `count` faces if it has more; of ten times as many, or more, if it
/// consists of parts so small that few faces would hide next to nothing. \param sides one per component.
/// \param sphere the scoring camera's.
SketchSurface sketch_surface(const TriMesh& surface, const std::vector<FaceSides>& sides,
                             const Sphere& sphere, std::size_t count);

/// The sides of each vertex. \param sides one per component.
std::vector<FaceSides> sides_of_vertices(const TriMesh& surface,
                                         const std::vector<FaceSides>& sides);

}  // namespace vantage
