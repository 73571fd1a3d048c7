// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"
#include "contraction/step_limits.h"
#include "operators/position_solver.h"
#include "operators/step_matrix.h"

namespace vantage {

/// How a step is taken: as defined, or more safely.
struct StepVariant {
  bool intrinsic = false;           ///< Weights of the intrinsic Delaunay triangulation.
  int regularisation = kAsDefined;  ///< A level of step_limits.h.
  double share = 1.0;               ///< Of W_L.
};

/// The equations by the intrinsic triangulation of a surface, whose pattern is another one at each step; ways to
/// take the same step differ in their pull alone.
struct IntrinsicSystem {
  std::vector<Vec3> positions{};
  LaplacianLimits limits{};
  Eigen::SparseMatrix<double> laplacian{};
  std::optional<NormalMatrix> normal{};  ///< None if it does not fit.
  PositionSolver solver{};
};

/// One step of the iteration: minimise |W_L L X'|² + Σ W_H,i² |x'_i − x_i|² by its normal equations.
/// What follows from the triangles alone is found once, and kept for other contractions of the same surface.
class StepSolver {
 public:
  /// \param start, shares must outlive this.
  StepSolver(const TriMesh& start, const EvenShares& shares);

  /// Positions after the step, or nothing if the system is not positive definite or the result is
  /// not finite. \throw Cancelled
  std::optional<std::vector<Vec3>> solve(const TriMesh& now, double W_L,
                                         const std::vector<double>& W_H,
                                         const ContractionOptions& options,
                                         const StepVariant& variant, const RunContext& run);

 private:
  IntrinsicSystem& intrinsic_of(const TriMesh& now, const LaplacianLimits& limits);

  const EvenShares& shares_;
  LaplacianAssembler laplacian_;
  std::optional<NormalMatrix> normal_{};
  PositionSolver system_{};
  std::optional<IntrinsicSystem> intrinsic_{};
};

}  // namespace vantage
