// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <Eigen/SparseCore>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/operators/cotangent_laplacian.h"

/// \file
/// The cotangent Laplacian of the surface itself rather than of its triangles: Fisher, Springborn,
/// Schröder, Bobenko, "An Algorithm for the Construction of Intrinsic Delaunay Triangulations with
/// Applications to Digital Geometry Processing", Computing 2007, doi:10.1007/s00607-007-0249-8.

namespace vantage {

/// As cotangent_laplacian(), of the intrinsic Delaunay triangulation of the same surface: edges are
/// flipped in the surface, without moving it, until no angles opposite one add up to more than π.
/// So no weight of an edge between two faces is negative, and slivers lose their extreme ones.
/// Lengths are first raised by what makes every triangle one (Sharp, Crane, "A Laplacian for
/// Nonmanifold Triangle Meshes", SGP 2020, doi:10.1111/cgf.14069, section 4.5: 10⁻⁵ of the mean
/// length). Edges of one face, of more than two, or of two that are wound against each other are
/// not flipped. The pattern depends on the positions.
/// \param positions |V| points. \param triangles no face names a vertex twice.
Eigen::SparseMatrix<double> intrinsic_laplacian(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const LaplacianLimits& limits = {});

}  // namespace vantage
