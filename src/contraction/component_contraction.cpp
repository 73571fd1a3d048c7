// SPDX-License-Identifier: MIT
#include "contraction/component_contraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "contraction/area_ratios.h"
#include "contraction/soundness.h"
#include "contraction/step_limits.h"
#include "contraction/step_solver.h"

namespace vantage {
namespace {

/// Ways to take a step, tried in order until one is sound: as defined; with weights that do not
/// depend on how the surface is cut into triangles; with less of a pull; and with clamped weights,
/// at last with a shifted diagonal.
constexpr std::array<StepVariant, 9> kVariants{{{false, kAsDefined, 1.0},
                                                {true, 1, 1.0},
                                                {true, 1, 1.0 / 3.0},
                                                {true, 1, 1.0 / 9.0},
                                                {false, 1, 1.0},
                                                {false, 2, 1.0},
                                                {false, 3, 1.0},
                                                {false, 4, 1.0},
                                                {false, kMostRegularised, 1.0}}};
/// Where the next step begins after one that could not be taken as defined.
constexpr std::size_t kSafer = 1;
/// Until a plate has lost this much its first steps round its edges off [a_t].
constexpr double kRounded = 0.9;
/// Above this share of the area a step is early: if it had to be taken another way, all later levels
/// would show it [a_t; ours].
constexpr double kEarly = 0.25;
/// A step that is too gentle for the surface to begin to shrink is made stronger this often at most.
constexpr int kMostStronger = 6;

/// What one attempt at a step gave.
struct Attempt {
  StepFlaw flaw = StepFlaw::Unsolved;
  TriMesh mesh{};
  std::vector<double> vertex_ratio{};
  double shrinkage = 0.0;
  double contraction = 0.0;  ///< [W_L] it was made with, before the variant's share.
  std::string remedy{};      ///< A sentence if it was not made as defined.
};

/// Why a contraction ends at a step of which none of the ways was sound. One that enlarges the
/// surface shrinks it by less than the tolerance.
ContractionStop stop_for(StepFlaw flaw) {
  switch (flaw) {
    case StepFlaw::Unsolved:
      return ContractionStop::SolverFailed;
    case StepFlaw::Grew:
      return ContractionStop::Grew;
    case StepFlaw::Collapsed:
      return ContractionStop::Collapsed;
    case StepFlaw::Rose:
    case StepFlaw::None:
      break;
  }
  return ContractionStop::Shrunk;
}

/// What a step would have done, for a user.
std::string description(StepFlaw flaw) {
  switch (flaw) {
    case StepFlaw::Unsolved:
      return "could not be solved";
    case StepFlaw::Grew:
      return "would have thrown part of the surface outwards";
    case StepFlaw::Rose:
      return "would have enlarged the surface";
    case StepFlaw::Collapsed:
      return "would have run part of the surface to a point";
    case StepFlaw::None:
      break;
  }
  return "";
}

/// How it was taken instead.
std::string description(const StepVariant& variant) {
  if (variant.intrinsic) {
    return std::string("taken with weights that thin triangles do not upset") +
           (variant.share < 1.0 ? " and a weaker pull" : "");
  }
  return "taken with bounded weights";
}

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
  Contraction(const TriMesh& scaled, const ContractionOptions& options, const EvenShares& shares,
              const RunContext& run, StepWeights weights, StepSolver& solver)
      : options_(options),
        run_(run),
        shares_(shares),
        soundness_(scaled),
        ratios_(scaled, shares),
        solver_(solver),
        variant_(weights == StepWeights::ForSlivers ? kSafer : 0) {
    const double first =
        shares.empty() ? first_contraction(ratios_.mean_area()) : shares.first_contraction();
    state_ = {scaled, std::min(first, options.contraction_limit),
              std::vector<double>(scaled.positions.size(), 1.0)};
  }

  /// False for a point or a needle.
  [[nodiscard]] bool has_area() const { return ratios_.mean_area() > 0.0; }

  [[nodiscard]] const State& state() const { return state_; }

  [[nodiscard]] bool is_regularised() const { return variant_ > 0; }

  /// Whether it ended because no way to take a step was sound, far from a curve.
  [[nodiscard]] bool is_stuck() const { return is_stuck_; }

  /// Whether an early step was not sound as it is defined.
  [[nodiscard]] bool was_unsound() const { return was_unsound_; }

  /// What was done about steps that could not be taken as defined, a clause each.
  [[nodiscard]] const std::vector<std::string>& remedies() const { return remedies_; }

  /// Takes the next step, unless no way to take it is sound or it shrinks the surface by less than
  /// the tolerance: then says why it ends. \param limit largest W_L from the next step on.
  std::optional<ContractionStop> step(double limit) {
    Attempt attempt = attempt_step(limit);
    if (attempt.flaw != StepFlaw::None) {
      return stop_for(attempt.flaw);
    }
    if (state_.shrinkage <= kBegun &&
        state_.shrinkage - attempt.shrinkage < least_progress(attempt.shrinkage)) {
      return ContractionStop::Shrunk;
    }
    if (!attempt.remedy.empty()) {
      remedies_.push_back(std::move(attempt.remedy));
    }
    state_.now = std::move(attempt.mesh);
    state_.shrinkage = attempt.shrinkage;
    ++state_.steps;
    const std::vector<double>& vertex_ratio = attempt.vertex_ratio;
    for (std::size_t v = 0; v < state_.attraction.size(); ++v) {
      state_.attraction[v] = std::min(1.0 / std::sqrt(vertex_ratio[v]), options_.attraction_limit);
    }
    const double W_L = state_.contraction;
    const bool is_limited = grown(W_L, limit) < grown(W_L, options_.sheet_limit);
    if (is_limited && !before_limit_) {
      before_limit_ = state_;
    }
    state_.contraction = grown(W_L, limit);
    return std::nullopt;
  }

  /// Goes back to where a lower limit began to tell, as if it had been `sheet_limit`. False if none
  /// did.
  bool rewind() {
    if (!before_limit_) {
      return false;
    }
    state_ = std::move(*before_limit_);
    state_.contraction = grown(state_.contraction, options_.sheet_limit);
    return true;
  }

 private:
  /// The W_L after this one: larger, up to the limit.
  [[nodiscard]] double grown(double W_L, double limit) const {
    return std::min(W_L * options_.contraction_growth, std::max(W_L, limit));
  }

  /// What a step to `shrinkage` must have taken off.
  [[nodiscard]] double least_progress(double shrinkage) const {
    return is_plate(shrinkage) && state_.shrinkage <= kRounded
               ? std::max(options_.shrinkage_tolerance, shares_.least_progress * state_.shrinkage)
               : options_.shrinkage_tolerance;
  }

  /// A step that is not sound is repeated more safely. A curve is done where the first way fails:
  /// what a safer one could still gain is not worth the risk.
  Attempt attempt_step(double limit) {
    const bool is_curve = !is_sheet(state_.shrinkage);
    StepFlaw first = StepFlaw::None;
    Attempt attempt;
    for (std::size_t variant = variant_; variant < kVariants.size(); ++variant) {
      attempt = attempt_in(kVariants[variant], limit);
      if (attempt.flaw == StepFlaw::None) {
        state_.contraction = attempt.contraction;
        if (first != StepFlaw::None) {
          attempt.remedy = go_on_by(kVariants[variant], first);
        }
        return attempt;
      }
      first = first == StepFlaw::None ? attempt.flaw : first;
      was_unsound_ = was_unsound_ || state_.shrinkage > kEarly;
      if (is_curve && attempt.flaw != StepFlaw::Unsolved) {
        return attempt;
      }
    }
    if (!is_curve) {
      is_stuck_ = true;
      remedies_.push_back("it ended at step " + std::to_string(state_.steps + 1) + ", which " +
                          description(attempt.flaw) + " however it was taken");
    }
    return attempt;
  }

  /// After a step that was sound by this way only. Says so, for when the step is kept.
  std::string go_on_by(const StepVariant& variant, StepFlaw else_flaw) {
    state_.contraction *= variant.share;
    variant_ = kSafer;
    return "step " + std::to_string(state_.steps + 1) + " " + description(else_flaw) + " and was " +
           description(variant);
  }

  /// With a larger W_L, up to the limit, while a surface that has not begun to shrink rises.
  Attempt attempt_in(const StepVariant& variant, double limit) {
    double W_L = state_.contraction;
    for (int stronger = 0;; ++stronger) {
      run_.check();
      std::optional<std::vector<Vec3>> solved = solver_.solve(
          state_.now, W_L * variant.share, state_.attraction, options_, variant, run_);
      if (!solved) {
        return {};
      }
      Attempt attempt{.mesh = {std::move(*solved), state_.now.triangles}};
      attempt.contraction = W_L;
      std::tie(attempt.vertex_ratio, attempt.shrinkage) = ratios_.of_vertices(attempt.mesh);
      attempt.flaw = soundness_.flaw(state_.now, attempt.mesh.positions, state_.shrinkage,
                                     attempt.shrinkage, bound_of(variant.regularisation));
      const bool too_gentle = attempt.flaw == StepFlaw::Rose && state_.shrinkage > kBegun &&
                              attempt.shrinkage < 2.0 - kBegun;
      const double larger = grown(W_L, limit);
      if (!too_gentle || stronger == kMostStronger || larger == W_L) {
        return attempt;
      }
      W_L = larger;
    }
  }

  const ContractionOptions& options_;
  const RunContext& run_;
  const EvenShares& shares_;
  Soundness soundness_;
  AreaRatios ratios_;
  StepSolver& solver_;
  State state_{};
  std::optional<State> before_limit_{};  // before the first step whose W_L a limit kept low
  std::size_t variant_;                  // of kVariants, where the next step begins
  std::vector<std::string> remedies_{};
  bool is_stuck_ = false;
  bool was_unsound_ = false;
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
                                    const RunContext& run, const EvenShares& shares,
                                    StepWeights weights) {
  StepSolver solver(scaled, shares);
  return contract_component(scaled, options, run, shares, weights, solver);
}

ComponentHistory contract_component(const TriMesh& scaled, const ContractionOptions& options,
                                    const RunContext& run, const EvenShares& shares,
                                    StepWeights weights, StepSolver& solver) {
  ComponentHistory history;
  history.summary.vertices = scaled.positions.size();
  history.levels.push_back(scaled.positions);
  history.shrinkage.push_back(1.0);
  Contraction surface(scaled, options, shares, run, weights, solver);
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
  history.summary.remedies = surface.remedies();
  history.is_stuck = surface.is_stuck();
  history.was_unsound = surface.was_unsound();
  if (history.summary.stop == ContractionStop::Shrunk) {
    history.thinned = thin_further(surface, options, run);
  }
  return history;
}

}  // namespace vantage
