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
      // L has a symmetric pattern, so that columns are as wide as rows.
      const bool is_wide =
          L.outerIndexPtr()[i + 1] - L.outerIndexPtr()[i] > NormalMatrix::kWidestRow;
      rows[i] = is_wide ? 0.0 : W_L * W_L / count;
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

/// What a step starts from.
struct State {
  TriMesh now{};
  double contraction = 0.0;          ///< [W_L]
  std::vector<double> attraction{};  ///< [W_H]
  double shrinkage = 1.0;            ///< [a_t]
  int steps = 0;                     ///< Taken so far.
};

/// The surface on its way.
class Contraction {
 public:
  Contraction(const TriMesh& scaled, const ContractionOptions& options, const FineShares& shares,
              const RunContext& run)
      : options_(options),
        run_(run),
        bounds_(scaled.positions),
        ratios_(scaled, shares),
        solver_(scaled, shares) {
    const double area = shares.empty() ? ratios_.mean_area() : shares.mean_face_area;
    state_ = {scaled, 1.0 / (10.0 * std::sqrt(area)),
              std::vector<double>(scaled.positions.size(), 1.0)};
  }

  /// False for a point or a needle.
  [[nodiscard]] bool has_area() const { return ratios_.mean_area() > 0.0; }

  [[nodiscard]] const State& state() const { return state_; }

  [[nodiscard]] bool is_regularised() const { return harshness_ > kGentlest; }

  /// Takes the next step, unless it fails or shrinks the surface by less than the tolerance: then
  /// says why it ends. \param limit largest W_L from the next step on.
  std::optional<ContractionStop> step(double limit) {
    Attempt attempt = attempt_step();
    if (!attempt.accepted) {
      return attempt.failure;
    }
    std::swap(state_.now.positions, attempt.positions);
    const auto [vertex_ratio, mean] = ratios_.of_vertices(state_.now);
    // The rule needs a surface that has begun to shrink: on fine smooth meshes the first steps
    // move less than the tolerance, and stopping there would leave level 0 alone.
    const bool begun = mean <= 1.0 - options_.shrinkage_tolerance;
    if (begun && state_.shrinkage - mean < options_.shrinkage_tolerance && !is_first()) {
      std::swap(state_.now.positions, attempt.positions);
      return ContractionStop::Shrunk;
    }
    state_.shrinkage = mean;
    ++state_.steps;
    for (std::size_t v = 0; v < state_.attraction.size(); ++v) {
      state_.attraction[v] = std::min(1.0 / std::sqrt(vertex_ratio[v]), options_.attraction_limit);
    }
    if (!limited_ && grown(options_.sheet_limit) > grown(limit)) {
      limited_ = state_;
    }
    state_.contraction = grown(limit);
    return std::nullopt;
  }

  /// Goes back to where a lower limit began to tell, as if it had been `sheet_limit`. False if none
  /// did.
  bool rewind() {
    if (!limited_) {
      return false;
    }
    state_ = std::move(*limited_);
    state_.contraction = grown(options_.sheet_limit);
    return true;
  }

 private:
  /// The next step's W_L.
  [[nodiscard]] double grown(double limit) const {
    return std::min(state_.contraction * options_.contraction_growth,
                    std::max(state_.contraction, limit));
  }

  [[nodiscard]] bool is_first() const { return state_.steps == 0; }

  /// Ill-conditioned steps are repeated more gently, and so is one that diverges, because obtuse
  /// slivers push apart what they join. If it diverges all the same the contraction ends, except at
  /// the first step: a surface that can be contracted must not be left at level 0.
  Attempt attempt_step() {
    Attempt attempt;
    for (; harshness_ <= kHarshest; ++harshness_) {
      run_.check();
      std::optional<std::vector<Vec3>> solved = solver_.solve(
          state_.now, state_.contraction, state_.attraction, options_, harshness_, run_);
      attempt.failure = solved ? ContractionStop::Grew : ContractionStop::SolverFailed;
      if (solved) {
        attempt.positions = std::move(*solved);
        attempt.accepted = !bounds_.exceeded_by(attempt.positions, harshness_);
        if (attempt.accepted || (!is_first() && is_regularised())) {
          break;
        }
      }
    }
    return attempt;
  }

  const ContractionOptions& options_;
  const RunContext& run_;
  Bounds bounds_;
  AreaRatios ratios_;
  StepSolver solver_;
  State state_{};
  std::optional<State> limited_{};  // before the first step whose W_L a limit kept low
  int harshness_ = kGentlest;
};

/// Contracts a surface that stopped shrinking as a sheet again, with a larger W_L from where the
/// limit began to tell: in a sheet many curves are equally good. Returns the thinnest curve that it
/// comes to before slivers come in the way, which would make curves of their own, or nothing.
std::vector<Vec3> thin_further(Contraction& surface, const ContractionOptions& options,
                               const RunContext& run) {
  if (!is_sheet(surface.state().shrinkage) || surface.is_regularised() || !surface.rewind()) {
    return {};
  }
  std::vector<Vec3> curve;
  while (surface.state().steps < options.max_steps) {
    run.advance("contracting", 0.5 + 0.5 * surface.state().steps / options.max_steps);
    const double before = surface.state().shrinkage;
    if (surface.step(options.sheet_limit) || surface.is_regularised() ||
        surface.state().shrinkage > before) {
      break;
    }
    if (!is_sheet(surface.state().shrinkage)) {
      curve = surface.state().now.positions;
    }
  }
  return curve;
}

}  // namespace

ComponentHistory contract_component(const TriMesh& scaled, const ContractionOptions& options,
                                    const RunContext& run, const FineShares& shares) {
  ComponentHistory history;
  history.summary.vertices = scaled.positions.size();
  history.levels.push_back(scaled.positions);
  history.shrinkage.push_back(1.0);
  Contraction surface(scaled, options, shares, run);
  if (!surface.has_area()) {
    return history;
  }
  history.summary.stop = ContractionStop::StepLimit;
  for (int step = 0; step < options.max_steps; ++step) {
    run.advance("contracting", 0.5 * step / options.max_steps);
    if (const std::optional<ContractionStop> stop = surface.step(options.contraction_limit)) {
      history.summary.stop = *stop;
      break;
    }
    history.levels.push_back(surface.state().now.positions);
    history.shrinkage.push_back(surface.state().shrinkage);
    ++history.summary.steps;
    history.summary.regularised_steps += surface.is_regularised() ? 1 : 0;
  }
  if (history.summary.stop == ContractionStop::Shrunk) {
    history.thinned = thin_further(surface, options, run);
    history.summary.strategy += history.thinned.empty() ? "" : ", thinned";
  }
  return history;
}

}  // namespace vantage
