// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include "vantage/operators/cotangent_laplacian.h"

namespace vantage {

/// From summed weights of edges to a Laplacian: clamps them as the limits say, sets the diagonal so
/// that rows add up to zero, and scales rows down.
/// \pre L has a full diagonal.
void finish_rows(Eigen::SparseMatrix<double>& L, const LaplacianLimits& limits);

}  // namespace vantage
