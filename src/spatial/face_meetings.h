// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

#include "mesh/surface_edges.h"

/// \file
/// Faces that meet others elsewhere than at corners and edges that they share, and what that says of
/// back faces. A shell is made of faces that edges hold together. From an eye outside a closed one, the
/// number of times that it winds around a place is that of fronts less that of backs on the line of sight to
/// the place. So its backs hide what its fronts do not only where the number is negative, and then there is one
/// among them with a negative number on its outer side. A shell that is wound outwards and nowhere meets itself
/// has none; where limbs pass through each other the number is 2. Other shells change nothing.

namespace vantage {

/// One entry a face.
struct FaceMeetings {
  /// 1 for each face whose back may hide something that no front hides, from an eye outside.
  std::vector<std::uint8_t> occluding_back_faces{};
  /// 1 for each face that may pass through another one or touch it.
  std::vector<std::uint8_t> crossed{};
};

/// \param mesh in a UnitFrame, without faces of zero area. \param edges of it.
FaceMeetings find_meetings(const TriMesh& mesh, const SurfaceEdges& edges);

}  // namespace vantage
