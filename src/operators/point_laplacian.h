// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <Eigen/SparseCore>

#include "vantage/operators/cotangent_laplacian.h"

#include "spatial/point_rings.h"

namespace vantage {

/// Sparse |P| × |P| matrix L with (L x)_i = Σ_j w_ij (x_j − x_i), w_ij = cot α_ij + cot β_ij over
/// the triangles of point i's own star (Cao 2010, section 3): rows are computed independently, so L
/// need not be symmetric. Its pattern depends on the rings alone.
/// \param positions |P| points, now; the rings stay those of the start.
Eigen::SparseMatrix<double, Eigen::RowMajor> point_laplacian(std::span<const Vec3> positions,
                                                             const PointRings& rings,
                                                             const LaplacianLimits& limits = {});

}  // namespace vantage
