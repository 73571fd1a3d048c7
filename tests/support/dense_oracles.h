// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/significance/kssm.h"

/// \file
/// Second implementations of the numerics, written straight from the formulas, dense and slow:
/// what the library's results are compared with. Nothing here calls the code it checks.

namespace vantage::test {

using DenseMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// cot α + cot β by the law of cosines, rows scaled down to `diagonal_limit`.
DenseMatrix dense_laplacian(const TriMesh& mesh, long double diagonal_limit);

/// Mean over the faces at each vertex of area now over area at the start (docs/contraction.md); −1
/// where no face counts.
std::vector<double> dense_area_ratios(const TriMesh& start, std::span<const Vec3> now);

/// The weights of step `step` (0 is the first), for a surface whose first level is `start` and whose
/// level before that step is `now`; both already scaled.
struct StepWeights {
  long double contraction = 0.0L;    ///< W_L.
  std::vector<double> attraction{};  ///< W_H of each vertex.
};

StepWeights step_weights(const TriMesh& start, std::span<const Vec3> now, int step,
                         const ContractionOptions& options);

/// Minimiser of |W_L L X|² + Σ W_H² |x − now|², by Householder QR of the stacked system in
/// long double: no normal equations, no sparsity.
DenseMatrix dense_step(const TriMesh& now, const StepWeights& weights, long double diagonal_limit);

/// Largest over the coordinates of |A x − b| / (|A| |x| + |b|), with the normal equations of the
/// step that leads from `now` to `next`. Frobenius norm of A, Euclidean of vectors.
double backward_error(const TriMesh& now, std::span<const Vec3> next, const StepWeights& weights,
                      long double diagonal_limit);

/// Distance to the nearest node or edge by looking at all of them.
double brute_force_distance(const CurveGraph& graph, const Vec3& point);

/// The significance map: every formula of docs/kssm.md evaluated as written, in long double.
std::vector<double> direct_kssm(const TriMesh& mesh, const ContractionHistory& history,
                                const CurveGraph& graph, const KssmOptions& options);

/// How often the surface winds around the point: sum of signed solid angles over 4π (van Oosterom,
/// Strackee, "The Solid Angle of a Plane Triangle", 1983).
double winding_number(const TriMesh& mesh, const Vec3& point);

}  // namespace vantage::test
