// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Curvature of a triangle mesh at its vertices.

namespace vantage {

/// Unit normal of each vertex, exact wherever the one-ring lies on a sphere: Max, "Weights for
/// Computing Vertex Normals from Facet Normals", 1999. Zero where no face has a normal.
std::vector<Vec3> sphere_exact_normals(const TriMesh& mesh);

/// Mean curvature of each vertex, 1 / model unit; positive where the surface bulges along its
/// winding's normal, so 1/R on a sphere of radius R wound outwards, exactly for any tessellation.
/// A least-squares fit of the second fundamental form to the normal curvatures towards the
/// neighbours (those of Taubin, "Estimating the Tensor of Curvature of a Surface from a Polyhedral
/// Approximation", 1995), with a tilt of the normal as Cazals and Pouget's jets have it, so that it
/// converges on uneven rings too. 0 at vertices whose faces do not close a ring around them: border,
/// non-manifold and isolated vertices.
std::vector<double> mean_curvatures(const TriMesh& mesh);

/// Angle deficit of each vertex, 2π − Σ of the angles of its faces there, in [−∞, 2π] radians: the
/// Gaussian curvature gathered at the vertex. 0 where mean_curvatures() is 0 by definition.
std::vector<double> angle_deficits(const TriMesh& mesh);

}  // namespace vantage
