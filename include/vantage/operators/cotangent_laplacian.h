// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <Eigen/SparseCore>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// The cotangent Laplacian of a triangle mesh: Pinkall, Polthier, "Computing Discrete Minimal
/// Surfaces and Their Conjugates", Experimental Mathematics 1993, doi:10.1080/10586458.1993.10504266;
/// weights cot α + cot β without ½, as Au 2008 and Cao 2010 use them.

namespace vantage {

/// How cotangents and rows are kept finite.
struct LaplacianLimits {
  /// A row whose diagonal exceeds this in magnitude is scaled down to it (Cao 2010: 10⁴); > 0.
  double diagonal = 1e4;
  /// Each cotangent is clamped to ± this; > 0. 10⁸ is the cotangent of 6·10⁻⁷ degrees, where
  /// double precision has lost the angle.
  double cotangent = 1e8;
  /// Clamp the weight of an edge from below at 0: obtuse slivers then pull instead of push.
  bool non_negative = false;

  bool operator==(const LaplacianLimits&) const = default;
};

/// Sparse |V| × |V| matrix L with (L x)_i = Σ_j w_ij (x_j − x_i), w_ij = cot α_ij + cot β_ij.
/// Its pattern depends on the triangles alone (zeros are stored), so that a symbolic analysis can
/// be reused while positions change. Zero-area faces contribute nothing.
/// \param positions |V| points. \param triangles no face names a vertex twice.
Eigen::SparseMatrix<double> cotangent_laplacian(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const LaplacianLimits& limits = {});

}  // namespace vantage
