// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/spatial/mirror_symmetry.h"

/// \file
/// How a surface would stand on the ground if a given direction were up. docs/prior.md says how a
/// guess of the up axis is made of it, and how often it is right.

namespace vantage {

/// Evidence for or against one direction being up. All of it is free of scale.
struct Stance {
  /// Area of the convex hull of what touches the ground, over that of the whole outline seen from
  /// above; in [0, 1].
  double base_share = 0.0;
  /// Whether the centre of the surface's area is above the base: the thing stands.
  bool stands = false;
  /// Height of that centre over the ground, as a share of the whole height; in [0, 1].
  double centre_height = 0.5;
  /// A mirror plane holds the direction, as those of animals, people and vehicles do.
  bool mirror_plane_upright = false;
  /// A mirror plane is level: top and bottom are alike.
  bool mirror_plane_level = false;
};

/// \param up unit vector. \param planes those of `surface`.
Stance stance(const TriMesh& surface, const Vec3& up, std::span<const MirrorPlane> planes);

/// Whether the evidence is strong that `other` is up where a file's format makes one expect
/// `expected`: only if the thing stands well with the first up, and not at all with the second.
bool stands_only_on(const Stance& other, const Stance& expected);

}  // namespace vantage
