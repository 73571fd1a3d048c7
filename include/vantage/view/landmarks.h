// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/scoring.h"

/// \file
/// Directions from which made things look special.

namespace vantage {

/// A large flat part of a surface, whether its faces hang together or not.
struct FlatPart {
  Vec3 normal = Vec3::UnitZ();  ///< Unit.
  double height = 0.0;          ///< How far its faces lie along the normal at most, model units.
};

/// Flat parts of at least 2 % of the area each, largest first, at most twelve.
std::vector<FlatPart> flat_parts(const TriMesh& surface);

/// Directions along which the score of a part with flat sides has narrow peaks and pits: both ways
/// along the coordinate axes, the surface's principal axes, and the normals of its largest flat
/// parts (at least 2 % of the area each, at most twelve). [ours]
/// \param walls flat_parts() of the surface.
/// \return unit vectors, at most 36, no two of them nearer than 0.1°, in an order that depends on
/// the surface alone; none for a surface without area.
std::vector<Vec3> landmark_directions(const TriMesh& surface, std::span<const FlatPart> walls);

/// Directions just before and just behind the brinks where a wall comes into sight: the camera's eye
/// faces a large flat part and passes the plane of another that stands across it. There many
/// vertices come and go at once. Empty for surfaces without flat parts.
/// \param walls flat_parts() of the surface.
std::vector<Vec3> brink_directions(std::span<const FlatPart> walls, const ScoringCamera& camera);

}  // namespace vantage
