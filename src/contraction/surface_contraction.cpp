// SPDX-License-Identifier: MIT
#include "contraction/surface_contraction.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contraction/refinement.h"
#include "contraction/step_solver.h"

namespace vantage {
namespace {

/// A plate stands still if a step takes off less than this share of it; it is contracted again by
/// larger steps so often at most [ours: a square plate needs all].
constexpr double kPlateStep = 0.05;
constexpr int kMostAgain = 3;

/// Vertices of an evener copy at most, and of a surface that it is made of at least [ours].
constexpr std::size_t kEvenCopy = 5'000;
constexpr std::size_t kFewestEven = 500;

/// What the vertices of a surface count by; Cao's sums run over vertices.
EvenShares shares_of(const TriMesh& mesh, const ContractionOptions& options) {
  return options.weights == ContractionWeights::Vertex ? EvenShares{} : even_shares(mesh);
}

ContractionOptions without_thinning(ContractionOptions options) {
  options.sheet_limit = options.contraction_limit;
  return options;
}

/// Whether an attempt got farther than the best before it, if there is one.
bool is_farther(const ComponentHistory& attempt, const ComponentHistory& best) {
  return best.shrinkage.empty() ||
         (!attempt.is_stuck && attempt.shrinkage.back() < best.shrinkage.back());
}

/// Whether it stands still as a plate.
bool is_held(const ComponentHistory& history) {
  return history.summary.stop == ContractionStop::Shrunk && is_plate(history.shrinkage.back());
}

/// Contracts a surface by even shares. The rim of a plate may become a line that holds the rest
/// where it is, by steps that are too small for so wide a surface: then all is done again by larger
/// ones, as long as that leads farther.
ComponentHistory contract_evenly(const TriMesh& scaled, const ContractionOptions& options,
                                 const RunContext& run, EvenShares shares,
                                 StepWeights weights = StepWeights::AsDefined) {
  ComponentHistory best;
  StepSolver solver(scaled, shares);
  double done = 0.0;
  for (int again = 0;; ++again) {
    const bool may_begin_again =
        again < kMostAgain &&
        shares.first_contraction() * options.contraction_growth <= options.contraction_limit;
    shares.least_progress = may_begin_again ? kPlateStep : 0.0;
    const RunContext part = run.part(done, 0.5 * (1.0 + done));
    done = 0.5 * (1.0 + done);
    ComponentHistory attempt = contract_component(scaled, options, part, shares, weights, solver);
    if (is_farther(attempt, best)) {
      best = std::move(attempt);
    } else if (!attempt.is_stuck) {  // larger steps may pass where these do not
      return best;
    }
    if (!may_begin_again || !is_held(best)) {
      return best;
    }
    shares.first_pull *= options.contraction_growth;
  }
}

/// Contracts a surface as options.weights says.
ComponentHistory contract_by(const TriMesh& mesh, const ContractionOptions& options,
                             const RunContext& run) {
  return options.weights == ContractionWeights::Vertex
             ? contract_component(mesh, options, run)
             : contract_evenly(mesh, options, run, even_shares(mesh));
}

/// Contracts a component at full resolution. A large one is thinned by its proxy all the same:
/// whether a sheet becomes a curve hangs on its slivers, and the methods should agree on it, so that the
/// proxy counts by area whatever options.weights says. Small ones are not thinned: their W_L begins far below its limit.
ComponentHistory contract_exactly(const TriMesh& scaled, const ContractionOptions& options,
                                  const RunContext& run) {
  ComponentHistory history = contract_by(scaled, without_thinning(options), run.part(0.0, 0.9));
  const bool may_be_thinned =
      options.sheet_limit > options.contraction_limit && scaled.positions.size() > kProxyFrom;
  // The proxy's a_t differs a little from the exact one, so the exact one must be below half the bound.
  if (may_be_thinned && is_sheet(2.0 * history.shrinkage.back())) {
    const Proxy proxy = make_proxy(scaled, kMergedSize, kProxySize, run);
    const ComponentHistory coarse =
        contract_component(proxy.mesh, options, run.part(0.9, 1.0), proxy.shares);
    const std::vector<Vec3>& curve =
        is_sheet(coarse.shrinkage.back()) ? coarse.thinned : coarse.levels.back();
    if (!curve.empty()) {
      history.thinned = carried(proxy, curve, run);
    }
  }
  return history;
}

/// A contraction to take in place of the one before, and the sentence that says of what it is.
struct Alternative {
  ComponentHistory history{};
  std::string remedy{};
};

/// All steps by weights that slivers do not upset.
std::optional<Alternative> contract_carefully(const TriMesh& scaled, const ComponentHistory& before,
                                              const ContractionOptions& options,
                                              const RunContext& run) {
  ComponentHistory careful = contract_component(
      scaled, without_thinning(options), run, shares_of(scaled, options), StepWeights::ForSlivers);
  if (careful.is_stuck && careful.shrinkage.back() >= before.shrinkage.back()) {
    return std::nullopt;
  }
  return Alternative{std::move(careful),
                     "all steps were taken anew with weights that thin triangles do not upset"};
}

/// A copy with fewer vertices and evener triangles: thin ones throw parts of a surface about.
std::optional<Alternative> contract_even_copy(const TriMesh& scaled, const ComponentHistory&,
                                              const ContractionOptions& options,
                                              const RunContext& run) {
  const auto most =
      static_cast<std::size_t>(kProxyShare * static_cast<double>(scaled.positions.size()));
  const std::size_t target = std::min(kEvenCopy, most);
  const Proxy proxy = make_proxy(scaled, target, target, run);
  if (proxy.mesh.positions.size() > most) {
    return std::nullopt;
  }
  ComponentHistory copy = contract_evenly(proxy.mesh, without_thinning(options), run, proxy.shares,
                                          StepWeights::ForSlivers);
  if (copy.is_stuck || copy.summary.steps == 0) {
    return std::nullopt;
  }
  for (auto& level : copy.levels) {
    level = carried(proxy, level, run);
  }
  copy.levels.front() = scaled.positions;
  return Alternative{std::move(copy), "a copy of " + std::to_string(proxy.mesh.positions.size()) +
                                          " vertices with evener triangles was contracted instead"};
}

/// A finer copy, whose first vertices are the surface's own: coarse meshes have too few to move.
std::optional<Alternative> contract_finer_copy(const TriMesh& scaled,
                                               const ComponentHistory& before,
                                               const ContractionOptions& options,
                                               const RunContext& run) {
  const TriMesh finer = refine_whole(scaled, run);
  if (finer.positions.size() == scaled.positions.size()) {
    return std::nullopt;
  }
  ComponentHistory copy = contract_by(finer, without_thinning(options), run);
  if (copy.is_stuck || copy.summary.steps <= before.summary.steps) {
    return std::nullopt;
  }
  for (auto& level : copy.levels) {
    level.resize(scaled.positions.size());
  }
  copy.strategy.finer_copy = finer.positions.size();
  return Alternative{std::move(copy), "a finer copy of " + std::to_string(finer.positions.size()) +
                                          " vertices was contracted instead"};
}

bool is_stuck(const ComponentHistory& history, const TriMesh&, const ContractionOptions&) {
  return history.is_stuck;
}

bool is_stuck_and_small(const ComponentHistory& history, const TriMesh& mesh,
                        const ContractionOptions&) {
  return history.is_stuck && mesh.positions.size() <= kProxyFrom;
}

/// Whether triangles may be in the way of a surface with enough of them for a copy.
bool is_unsound(const ComponentHistory& history, const TriMesh& mesh,
                const ContractionOptions& options) {
  return (history.was_unsound || history.is_stuck) && options.weights == ContractionWeights::Area &&
         mesh.positions.size() >= kFewestEven;
}

/// Another way to contract a surface, and when it is worth a try.
struct Fallback {
  bool (*is_called_for)(const ComponentHistory&, const TriMesh&, const ContractionOptions&);
  std::optional<Alternative> (*contract)(const TriMesh&, const ComponentHistory&,
                                         const ContractionOptions&, const RunContext&);
};

/// Tried in this order, each after what the ones before have led to.
constexpr std::array<Fallback, 3> kFallbacks{{{is_unsound, contract_even_copy},
                                              {is_stuck, contract_carefully},
                                              {is_stuck_and_small, contract_finer_copy}}};

/// Contracts again, in the ways above, what did not become a curve or was not sound.
void mend(ComponentHistory& history, const TriMesh& scaled, const ContractionOptions& options,
          const RunContext& run) {
  for (std::size_t k = 0; k < kFallbacks.size(); ++k) {
    if (!kFallbacks[k].is_called_for(history, scaled, options)) {
      continue;
    }
    const double share = 1.0 / static_cast<double>(kFallbacks.size());
    const RunContext part =
        run.part(static_cast<double>(k) * share, static_cast<double>(k + 1) * share);
    if (std::optional<Alternative> alternative =
            kFallbacks[k].contract(scaled, history, options, part)) {
      std::vector<std::string> remedies = std::move(history.summary.remedies);
      remedies.push_back(std::move(alternative->remedy));
      alternative->history.strategy.method = std::move(history.strategy.method);
      history = std::move(alternative->history);
      history.thinned.clear();
      std::vector<std::string>& own = history.summary.remedies;
      own.insert(own.begin(), remedies.begin(), remedies.end());
    }
  }
}

}  // namespace

ComponentHistory contract_surface(const TriMesh& scaled, const std::optional<Proxy>& proxy,
                                  const ContractionOptions& options, const RunContext& run) {
  ComponentHistory history;
  if (proxy) {
    history = contract_by(proxy->mesh, options, run.part(0.0, 0.7));
    history.strategy.method = "proxy " + std::to_string(proxy->mesh.positions.size());
    if (history.is_stuck) {
      mend(history, proxy->mesh, options, run.part(0.7, 1.0));
    }
  } else {
    if (options.method == ContractionMethod::Exact) {
      history = contract_exactly(scaled, options, run.part(0.0, 0.7));
    } else {
      history = contract_by(scaled, without_thinning(options), run.part(0.0, 0.7));
      history.strategy.method = "direct";
    }
    mend(history, scaled, options, run.part(0.7, 1.0));
  }
  history.summary.vertices = scaled.positions.size();
  history.strategy.is_thinned = !history.thinned.empty();
  return history;
}

}  // namespace vantage
