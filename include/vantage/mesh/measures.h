// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Lengths, areas, volumes and bounds.

namespace vantage {

/// Axis-aligned box; for no points at all, low = high = 0.
struct Box {
  Vec3 low = Vec3::Zero();   ///< Corner of least coordinates.
  Vec3 high = Vec3::Zero();  ///< Corner of greatest coordinates.

  [[nodiscard]] Vec3 size() const { return high - low; }  ///< Sides.

  [[nodiscard]] double longest_side() const {
    return size().maxCoeff();
  }  ///< Longest of the three.
};

/// Sphere given by centre and diameter [D].
struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< In model units.
  double diameter = 0.0;       ///< ≥ 0; every tolerance of the library is relative to it.
};

/// Smallest axis-aligned box around the points.
Box bounding_box(std::span<const Vec3> points);

/// Smallest enclosing sphere of the points, exact to rounding (relative excess ≤ 1e-10).
/// Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991, over a growing active set.
Sphere enclosing_sphere(std::span<const Vec3> points);

/// Points that at least one triangle names; all points if there are no triangles at all.
std::vector<Vec3> referenced_points(const TriMesh& mesh);

/// Cross product of two sides: twice the area, along the outward normal.
Vec3 area_vector(const TriMesh& mesh, const Triangle& triangle);

/// Area of each triangle, ≥ 0.
std::vector<double> face_areas(const TriMesh& mesh);

/// One third of the area of the triangles at each vertex.
std::vector<double> vertex_areas(const TriMesh& mesh);

/// Sum of all face areas.
double surface_area(const TriMesh& mesh);

/// Volume enclosed by consistently wound closed surfaces; negative if wound inside out.
double signed_volume(const TriMesh& mesh);

}  // namespace vantage
