// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// Unit normals at the three corners of each face, for smooth shading.
///
/// A corner's normal is the sum of the normals of all faces at its *position* (so that surfaces
/// without shared vertices are smooth too) weighted by their angle there, leaving out faces that
/// bend away from this one by more than `crease_rad`: edges sharper than that stay crisp. Faces
/// wound the other way count with their normal turned. Zero-area faces neither give nor get a
/// normal: theirs is zero.
/// Weights by angle: Thürmer, Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998.
std::vector<std::array<Vec3f, 3>> corner_normals(const TriMesh& mesh, double crease_rad,
                                                 const RunContext& run = {});

}  // namespace vantage
