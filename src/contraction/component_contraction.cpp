// SPDX-License-Identifier: MIT
#include "contraction/component_contraction.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/SparseCore>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/operators/cotangent_laplacian.h"

#include "contraction/step_limits.h"
#include "operators/position_solver.h"
#include "operators/step_matrix.h"

namespace vantage {
namespace {

/// Faces that begin smaller than this fraction of the mean area say nothing by their ratio.
constexpr double kTinyFace = 1e-6;
/// A vertex may get this far from the first enclosing sphere's centre, in radii. The box does not
/// see one vertex that flies off while the others shrink, and what it sees depends on the axes.
constexpr double kFarthest = 1.2;

/// A correction of more than this share of the solution says that neither is worth much: at the
/// gentlest limits the step counts as not solved, and harsher ones are tried; under those the
/// solution stands as it is, as there may be none better [ours].
constexpr double kTrusted = 1e-2;

/// Rows are read as wholes.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Area ratios of faces, then of vertices, against the start.
class AreaRatios {
 public:
  AreaRatios(const TriMesh& start, const FineShares& shares)
      : start_(face_areas(start)), faces_of_vertex_(vertex_faces(start)), shares_(shares) {
    double mean = 0.0;
    for (const double area : start_) {
      mean += area;
    }
    mean /= static_cast<double>(start_.size());
    smallest_ = kTinyFace * mean;
    mean_area_ = mean;
  }

  [[nodiscard]] double mean_area() const { return mean_area_; }

  /// Mean over the faces at each vertex of area now over area at the start; vertices without a
  /// face that counts take the mean of the others. Returns that mean [a_t] too.
  [[nodiscard]] std::pair<std::vector<double>, double> of_vertices(const TriMesh& now) const {
    const std::vector<double> areas = face_areas(now);
    std::vector<double> ratio(faces_of_vertex_.size(), -1.0);
    double sum = 0.0;
    double counted = 0.0;
    for (std::size_t v = 0; v < ratio.size(); ++v) {
      double total = 0.0;
      int faces = 0;
      for (const std::uint32_t f : faces_of_vertex_[v]) {
        if (start_[f] >= smallest_) {
          total += areas[f] / start_[f];
          ++faces;
        }
      }
      if (faces > 0) {
        const double count = shares_.empty() ? 1.0 : shares_.count[v];
        ratio[v] = total / faces * (shares_.empty() ? 1.0 : shares_.area[v]);
        sum += count * ratio[v];
        counted += count;
      }
    }
    const double mean = counted > 0.0 ? sum / counted : 0.0;
    for (double& r : ratio) {
      r = r < 0.0 ? mean : r;
    }
    return {std::move(ratio), mean};
  }

 private:
  std::vector<double> start_;
  IndexLists faces_of_vertex_;
  const FineShares& shares_;
  double smallest_ = 0.0;
  double mean_area_ = 0.0;
};

/// −½ the gradient of |W_L L (x + d)|² + Σ W_H,i² |d_i|² at the displacement d.
class Pull {
 public:
  /// \param L a Laplacian: its rows add up to zero. \param rows W_L² of each row.
  /// \param held W_H² of each vertex. All must outlive this.
  Pull(const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& rows,
       const Eigen::VectorXd& held)
      : L_(L), rows_(rows), held_(held) {}

  /// \param moved x + d.
  [[nodiscard]] Eigen::MatrixX3d at(const Positions& moved, const Eigen::MatrixX3d& d) const {
    // By differences of positions: rounding then is relative to edges, not to the model.
    Positions bent = Positions::Zero(moved.rows(), 3);
    for (int j = 0; j < L_.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L_, j); entry; ++entry) {
        bent.row(entry.row()) += entry.value() * (moved.row(j) - moved.row(entry.row()));
      }
    }
    bent.array().colwise() *= rows_.array();
    Eigen::MatrixX3d pull(moved.rows(), 3);
    for (int j = 0; j < L_.outerSize(); ++j) {
      Eigen::RowVector3d sum = held_[j] * d.row(j);
      for (Eigen::SparseMatrix<double>::InnerIterator entry(L_, j); entry; ++entry) {
        sum += entry.value() * bent.row(entry.row());
      }
      pull.row(j) = -sum;
    }
    return pull;
  }

 private:
  const Eigen::SparseMatrix<double>& L_;
  const Eigen::VectorXd& rows_;
  const Eigen::VectorXd& held_;
};

/// One step of the iteration: minimise |W_L L X'|² + Σ W_H,i² |x'_i − x_i|² by its normal equations.
class StepSolver {
 public:
  StepSolver(const TriMesh& start, const FineShares& shares)
      : shares_(shares), laplacian_(start.positions.size(), start.triangles) {}

  /// Positions after the step, or nothing if the system is not positive definite or the result is
  /// not finite.
  std::optional<std::vector<Vec3>> solve(const TriMesh& now, double W_L,
                                         const std::vector<double>& W_H,
                                         const ContractionOptions& options, int harshness,
                                         const RunContext& run) {
    const Eigen::SparseMatrix<double>& L =
        laplacian_.assemble(now.positions, limits_of(options, harshness));
    if (!normal_) {
      normal_.emplace(L);
    }
    const auto n = static_cast<Eigen::Index>(now.positions.size());
    Eigen::VectorXd rows(n);
    Eigen::VectorXd held(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto v = static_cast<std::size_t>(i);
      const double count = shares_.empty() ? 1.0 : shares_.count[v];
      rows[i] = W_L * W_L / count;
      held[i] = count * W_H[v] * W_H[v];
    }
    Eigen::SparseMatrix<double>& A = normal_->assemble(L, rows, held);
    const double shift = shift_of(A.diagonal().maxCoeff(), harshness);
    if (shift > 0.0) {
      for (Eigen::Index i = 0; i < n; ++i) {
        A.coeffRef(i, i) += shift;
      }
      held.array() += shift;
    }
    if (!system_.factorize(A, run)) {
      return std::nullopt;
    }
    return refined(now.positions, Pull(L, rows, held), harshness);
  }

 private:
  /// Corrected semi-normal equations (Björck, "Stability analysis of the method of seminormal
  /// equations", 1987): the factor is that of the normal equations, the residual that of the
  /// least-squares problem, which they would square away.
  [[nodiscard]] std::optional<std::vector<Vec3>> refined(const std::vector<Vec3>& start,
                                                         const Pull& pull, int harshness) const {
    const auto n = static_cast<Eigen::Index>(start.size());
    Positions x(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      x.row(i) = start[static_cast<std::size_t>(i)].transpose();
    }
    Eigen::MatrixX3d d = system_.solve(pull.at(x, Eigen::MatrixX3d::Zero(n, 3)));
    const Eigen::MatrixX3d correction = system_.solve(pull.at(x + d, d));
    if (correction.norm() <= kTrusted * d.norm()) {
      d += correction;
    } else if (harshness == kGentlest) {
      return std::nullopt;
    }
    if (!d.allFinite()) {
      return std::nullopt;
    }
    std::vector<Vec3> moved(start);
    for (Eigen::Index i = 0; i < n; ++i) {
      moved[static_cast<std::size_t>(i)] += d.row(i).transpose();
    }
    return moved;
  }

  const FineShares& shares_;
  LaplacianAssembler laplacian_;
  std::optional<NormalMatrix> normal_{};
  PositionSolver system_{};
};

/// What a step must not outgrow.
class Bounds {
 public:
  explicit Bounds(const std::vector<Vec3>& start)
      : sphere_(enclosing_sphere(start)), largest_(largest_box(start, sphere_.diameter)) {}

  /// True if a step of this harshness that ends at `now` has diverged.
  [[nodiscard]] bool exceeded_by(const std::vector<Vec3>& now, int harshness) const {
    return (bounding_box(now).size().array() > largest_.array()).any() ||
           (harshness == kGentlest && strayed(now));
  }

 private:
  [[nodiscard]] bool strayed(const std::vector<Vec3>& now) const {
    const double farthest = kFarthest * 0.5 * sphere_.diameter;
    return std::any_of(now.begin(), now.end(), [&](const Vec3& p) {
      return (p - sphere_.centre).squaredNorm() > farthest * farthest;
    });
  }

  Sphere sphere_;
  Vec3 largest_;
};

/// What one attempt at a step gave.
struct Attempt {
  std::vector<Vec3> positions{};
  ContractionStop failure = ContractionStop::SolverFailed;
  bool accepted = false;
};

/// Ill-conditioned steps are repeated more gently, and so is one that diverges, because obtuse
/// slivers push apart what they join. If it diverges all the same the contraction ends, except at
/// the first step: a surface that can be contracted must not be left at level 0.
/// \param solve the step at the harshness that is current.
template <class Solve>
Attempt attempt_step(bool first, int& harshness, const Bounds& bounds, const RunContext& run,
                     const Solve& solve) {
  Attempt attempt;
  for (; harshness <= kHarshest; ++harshness) {
    run.check();
    std::optional<std::vector<Vec3>> solved = solve();
    attempt.failure = solved ? ContractionStop::Grew : ContractionStop::SolverFailed;
    if (solved) {
      attempt.positions = std::move(*solved);
      attempt.accepted = !bounds.exceeded_by(attempt.positions, harshness);
      if (attempt.accepted || (!first && harshness > kGentlest)) {
        break;
      }
    }
  }
  return attempt;
}

}  // namespace

ComponentHistory contract_component(const TriMesh& scaled, const ContractionOptions& options,
                                    const RunContext& run, const FineShares& shares) {
  ComponentHistory history;
  history.summary.vertices = scaled.positions.size();
  history.levels.push_back(scaled.positions);
  history.shrinkage.push_back(1.0);
  const AreaRatios ratios(scaled, shares);
  if (!(ratios.mean_area() > 0.0)) {
    return history;
  }
  const Bounds bounds(scaled.positions);
  TriMesh now = scaled;
  StepSolver solver(scaled, shares);
  double W_L =
      1.0 / (10.0 * std::sqrt(shares.empty() ? ratios.mean_area() : shares.mean_face_area));
  std::vector<double> W_H(scaled.positions.size(), 1.0);
  int harshness = kGentlest;
  history.summary.stop = ContractionStop::StepLimit;

  for (int step = 0; step < options.max_steps; ++step) {
    run.advance("contracting", static_cast<double>(step) / options.max_steps);
    const bool first = history.summary.steps == 0;
    Attempt attempt = attempt_step(first, harshness, bounds, run, [&] {
      return solver.solve(now, W_L, W_H, options, harshness, run);
    });
    if (!attempt.accepted) {
      history.summary.stop = attempt.failure;
      break;
    }
    now.positions = std::move(attempt.positions);
    const auto [vertex_ratio, mean] = ratios.of_vertices(now);
    // The rule needs a surface that has begun to shrink: on fine smooth meshes the first steps
    // move less than the tolerance, and stopping there would leave level 0 alone.
    const bool begun = mean <= 1.0 - options.shrinkage_tolerance;
    if (begun && history.shrinkage.back() - mean < options.shrinkage_tolerance && !first) {
      history.summary.stop = ContractionStop::Shrunk;
      break;
    }
    history.levels.push_back(now.positions);
    history.shrinkage.push_back(mean);
    ++history.summary.steps;
    history.summary.regularised_steps += harshness > kGentlest ? 1 : 0;
    W_L = std::min(W_L * options.contraction_growth, std::max(W_L, options.contraction_limit));
    for (std::size_t v = 0; v < W_H.size(); ++v) {
      W_H[v] = std::min(1.0 / std::sqrt(vertex_ratio[v]), options.attraction_limit);
    }
  }
  return history;
}

}  // namespace vantage
