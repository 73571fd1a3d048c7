// SPDX-License-Identifier: MIT
#include "contraction/point_steps.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "contraction/soundness.h"
#include "contraction/step_limits.h"
#include "operators/point_laplacian.h"
#include "operators/position_solver.h"

namespace vantage {
namespace {

struct EdgeLengths {
  std::vector<double> shortest{};  ///< Of each point's ring; 0 where it has none.
  double mean = 0.0;               ///< Over points of the mean over the ring.
  double sum = 0.0;                ///< Of `shortest`.
};

EdgeLengths measure(const std::vector<Vec3>& points, const PointRings& rings) {
  EdgeLengths lengths;
  lengths.shortest.assign(points.size(), 0.0);
  double counted = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto ring = rings.neighbours[i];
    double shortest = std::numeric_limits<double>::infinity();
    double total = 0.0;
    for (const std::uint32_t j : ring) {
      const double length = (points[j] - points[i]).norm();
      shortest = std::min(shortest, length);
      total += length;
    }
    if (!ring.empty()) {
      lengths.shortest[i] = shortest;
      lengths.sum += shortest;
      lengths.mean += total / static_cast<double>(ring.size());
      counted += 1.0;
    }
  }
  lengths.mean = counted > 0.0 ? lengths.mean / counted : 0.0;
  return lengths;
}

/// One step by its normal equations.
class PointStep {
 public:
  std::optional<std::vector<Vec3>> solve(const std::vector<Vec3>& now, const PointRings& rings,
                                         double W_L, const std::vector<double>& W_H,
                                         const ContractionOptions& options, int regularisation,
                                         const RunContext& run) {
    const Eigen::SparseMatrix<double> L =
        point_laplacian(now, rings, limits_of(options, regularisation));
    Eigen::SparseMatrix<double> A = Eigen::SparseMatrix<double>(L.transpose()) * L;
    A *= W_L * W_L;
    const auto n = static_cast<Eigen::Index>(now.size());
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double w = W_H[static_cast<std::size_t>(i)];
      largest = std::max(largest, A.coeffRef(i, i) += w * w);
    }
    const double shift = shift_of(largest, regularisation);
    Eigen::MatrixX3d B(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto v = static_cast<std::size_t>(i);
      A.coeffRef(i, i) += shift;
      B.row(i) = (W_H[v] * W_H[v] + shift) * now[v].transpose();
    }
    return positions_.solve(A, B, run);
  }

 private:
  PositionSolver positions_{};
};

/// What came of a step.
struct PointAttempt {
  std::optional<std::vector<Vec3>> next{};
  int regularisation = kAsDefined;  ///< It was taken with.
  ContractionStop stop =
      ContractionStop::SolverFailed;  ///< Why there is no result, if there is none.
};

/// Repeats a step with more regularisation while it fails or outgrows its box. A curve that would run to a
/// point is done, as those of surfaces are. Whether the step shrinks anything is not asked here.
template <class Solve>
PointAttempt attempt_step(const Soundness& soundness, const TriMesh& now, int regularisation,
                          const RunContext& run, const Solve& solve) {
  PointAttempt attempt{.regularisation = regularisation};
  for (; attempt.regularisation <= kMostRegularised; ++attempt.regularisation) {
    run.check();
    attempt.next = solve(attempt.regularisation);
    if (!attempt.next) {
      attempt.stop = ContractionStop::SolverFailed;
      continue;
    }
    const StepFlaw flaw = soundness.flaw(now, *attempt.next, 0.0, 0.0, StepBound::Box);
    if (flaw == StepFlaw::None) {
      return attempt;
    }
    attempt.stop = flaw == StepFlaw::Collapsed ? ContractionStop::Collapsed : ContractionStop::Grew;
    if (flaw == StepFlaw::Collapsed) {
      break;
    }
  }
  attempt.next.reset();
  return attempt;
}

}  // namespace

ComponentHistory contract_point_component(const std::vector<Vec3>& scaled, const PointRings& rings,
                                          const ContractionOptions& options,
                                          const RunContext& run) {
  ComponentHistory history;
  history.summary.vertices = scaled.size();
  history.strategy.method = "points";
  history.levels.push_back(scaled);
  history.shrinkage.push_back(1.0);
  const EdgeLengths start = measure(scaled, rings);
  if (!(start.mean > 0.0)) {
    return history;
  }
  // Those that a single ring has, too: triangles may overlap, but every point is checked.
  TriMesh now{scaled, agreed_triangles(rings, 1)};
  const Soundness soundness(now);
  PointStep stepper;
  double W_L = 1.0 / (5.0 * start.mean);
  std::vector<double> W_H(scaled.size(), 1.0);
  int regularisation = kAsDefined;
  history.summary.stop = ContractionStop::StepLimit;
  for (int step = 0; step < options.max_steps; ++step) {
    run.advance("contracting", static_cast<double>(step) / options.max_steps);
    PointAttempt attempt = attempt_step(soundness, now, regularisation, run, [&](int as) {
      return stepper.solve(now.positions, rings, W_L, W_H, options, as, run);
    });
    if (!attempt.next) {
      history.summary.stop = attempt.stop;
      break;
    }
    regularisation = attempt.regularisation;
    const EdgeLengths lengths = measure(*attempt.next, rings);
    const double shrinkage = lengths.sum / start.sum;
    const double before = history.shrinkage.back();
    if (before <= kBegun && before - shrinkage < options.shrinkage_tolerance) {
      history.summary.stop = ContractionStop::Shrunk;
      break;
    }
    if (shrinkage <= before) {  // a step too gentle to shrink anything is made stronger
      now.positions = std::move(*attempt.next);
      history.levels.push_back(now.positions);
      history.shrinkage.push_back(shrinkage);
      ++history.summary.steps;
      history.summary.regularised_steps += regularisation > kAsDefined ? 1 : 0;
      for (std::size_t i = 0; i < W_H.size(); ++i) {
        const double ratio = start.shortest[i] / lengths.shortest[i];
        W_H[i] = ratio < options.attraction_limit ? ratio : options.attraction_limit;  // NaN too
      }
    }
    W_L = std::min(W_L * options.contraction_growth, std::max(W_L, options.contraction_limit));
  }
  return history;
}

}  // namespace vantage
