// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Procedural shapes with known answers. All closed ones are wound outwards.

namespace vantage::test {

/// Icosphere of radius 1 around the origin; level n has 10·4^n + 2 vertices.
TriMesh sphere(int level);

/// The surface of a cube of so many cells a side, drawn out to the unit sphere: alike angles a cell.
TriMesh cube_sphere(int cells);

/// UV torus around the z axis. \param major distance of the tube's axis from the origin.
TriMesh torus(double major, double minor, int major_segments, int minor_segments);

/// Box [0,x]×[0,y]×[0,z], every side split into cells × cells quads of two triangles.
TriMesh box(double x, double y, double z, int cells);

/// Closed cylinder along z from 0 to height, with flat caps fanned from their centres.
TriMesh cylinder(double radius, double height, int around, int along);

/// The same without caps: open, two boundary loops.
TriMesh open_cylinder(double radius, double height, int around, int along);

/// Closed surface of three tubes of length 1 that meet at the origin in the xy plane, at 90°, 210°
/// and 330°; built on a grid by marching tetrahedra. \param radius of the tubes.
/// \param cells resolution over the shape's extent.
TriMesh y_of_tubes(double radius, int cells);

/// A sphere in every seventh face of which a vertex lies `height` of the face's height from a side:
/// angles of almost 180°, whose cotangents of −1/height push instead of pull. Its edges are too short
/// for it to be refined first.
TriMesh sphere_with_caps(double height);

/// Flat rectangle [0,x]×[0,y] in the plane z = 0, facing +z, cells × cells quads.
TriMesh sheet(double x, double y, int cells);

/// A wall of 4 × 4 × 1 around the z axis with a square window of half its width. 32 faces.
TriMesh wall_with_window();

/// Both meshes in one, the second moved by `shift`.
TriMesh together(const TriMesh& first, const TriMesh& second, const Vec3& shift);

/// Points alone: of a unit sphere, and of a straight row from it to (0, 4, 0), the last 20 of which are
/// above y = 2. No triangle joins those of the row.
TriMesh points_of_ball_and_pole();

/// The same surface with faces reversed.
TriMesh inside_out(TriMesh mesh);

/// The same triangles without shared vertices, as in an STL file.
TriMesh soup(const TriMesh& mesh);

/// The mesh after x ↦ scale · (rotation by angle about axis) x + shift.
TriMesh moved(TriMesh mesh, double scale, double angle_rad, const Vec3& axis, const Vec3& shift);

/// Vertices renumbered by a seeded permutation; `old_of_new` receives it if not null.
TriMesh renumbered(const TriMesh& mesh, unsigned seed,
                   std::vector<std::uint32_t>* old_of_new = nullptr);

}  // namespace vantage::test
