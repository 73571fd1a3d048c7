// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

#include "mesh/surface_edges.h"

/// \file
/// Faces that meet others elsewhere than at corners and edges that they share, and what that says of
/// back faces. A shell is made of faces that edges hold together. On a closed one that is wound outwards
/// and nowhere meets itself, a line of sight that passes a back enters the shell, and to reach an eye
/// outside it must leave through a front: what the back hides that front hides too, whatever other
/// shells do.

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
