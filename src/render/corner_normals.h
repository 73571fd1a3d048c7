// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// Between which angles of two faces, in radians, an edge turns from smooth to crisp.
struct Crease {
  double smooth_rad = 0.0;  ///< Up to here a face counts in full.
  double crisp_rad = 0.0;   ///< From here on it does not count; above smooth_rad, at most π/2.
};

/// Unit normals at the three corners of each face, for smooth shading.
///
/// A corner's normal is the sum of the normals of all faces at its *position* (so that surfaces
/// without shared vertices are smooth too), weighted by their angle there, their area, and how
/// little they bend away from this corner's face. Faces wound the other way count with their normal
/// turned. Zero-area faces neither give nor get a normal: theirs is zero.
/// Angles make the result independent of how a polygon was cut into triangles (Thürmer, Wüthrich,
/// "Computing Vertex Normals from Polygonal Facets", 1998); areas, ours, keep the flat sides of CAD
/// parts flat up to the fillets beside them.
std::vector<std::array<Vec3f, 3>> corner_normals(const TriMesh& mesh, const Crease& crease,
                                                 const RunContext& run = {});

}  // namespace vantage
