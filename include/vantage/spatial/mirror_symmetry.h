// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Planes in which a surface mirrors itself, and what they make of its proportions.

namespace vantage {

/// Options of mirror_planes().
struct MirrorOptions {
  /// Largest distance of a mirrored part of the surface to the surface, over twice the longest
  /// distance from the centroid, at all but `outlier_share` of the area; > 0. [ours] A raised arm's
  /// asymmetry is larger, that of a scan's noise smaller.
  double tolerance = 0.01;
  double outlier_share = 0.02;  ///< Share of the area that may break the symmetry, in [0, 1).
};

/// A plane through the surface's centroid that mirrors the surface to itself.
struct MirrorPlane {
  Vec3 normal = Vec3::UnitX();  ///< Unit; its largest component is positive.
  Vec3 point = Vec3::Zero();    ///< The centroid, model units.
};

/// Looks for mirror planes among those that are orthogonal to a principal axis of the surface's
/// area or to a coordinate axis; planes within 5° of an earlier one are the same. Compares samples
/// of the surface, so that the tessellation does not matter. At most 6, in that order.
/// Throws nothing of its own: options are not checked.
/// \complexity O(|F| log |F|).
std::vector<MirrorPlane> mirror_planes(const TriMesh& surface, const MirrorOptions& options = {});

/// The direction, as a unit vector, and its images under all products of the reflections: itself first, none within
/// `apart_rad` of an earlier one. \throw InvalidInput if the direction is zero or not finite
std::vector<Vec3> mirror_images(const Vec3& direction, std::span<const MirrorPlane> planes,
                                double apart_rad);

/// What of a shape the views that people choose hang on most: the proportions of its box along
/// side, up and front, and its mirror planes. Lengths are over the radius of the enclosing sphere,
/// each + 0.02, so that thin things differ in no more than that.
struct ShapeProportions {
  double height = 0.0;         ///< log(up / √(side · front))
  double width = 0.0;          ///< log(side / front)
  bool mirrors_side = false;   ///< Left and right look alike.
  bool mirrors_front = false;  ///< Front and back look alike.
  bool mirrors_up = false;     ///< Top and bottom look alike.
};

}  // namespace vantage
