// SPDX-License-Identifier: MIT
#include "contraction/surface_contraction.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "contraction/refinement.h"

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

/// Contracts a surface by even shares. The rim of a plate may become a line that holds the rest
/// where it is, by steps that are too small for so wide a surface: then all is done again by larger
/// ones.
ComponentHistory contract_evenly(const TriMesh& scaled, const ContractionOptions& options,
                                 const RunContext& run, EvenShares shares,
                                 bool is_careful = false) {
  ComponentHistory history;
  double done = 0.0;
  for (int again = 0;; ++again) {
    const bool may_begin_again =
        again < kMostAgain &&
        shares.first_contraction() * options.contraction_growth <= options.contraction_limit;
    shares.least_progress = may_begin_again ? kPlateStep : 0.0;
    const RunContext part = run.part(done, 0.5 * (1.0 + done));
    done = 0.5 * (1.0 + done);
    ComponentHistory attempt = contract_component(scaled, options, part, shares, is_careful);
    if (again == 0 || !attempt.is_stuck) {  // larger steps may pass where these do not
      if (again > 0 && attempt.shrinkage.back() >= history.shrinkage.back()) {
        return history;
      }
      history = std::move(attempt);
    }
    if (!may_begin_again || history.summary.stop != ContractionStop::Shrunk ||
        !is_plate(history.shrinkage.back())) {
      return history;
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
/// whether a sheet becomes a curve hangs on its slivers, and the methods should agree on it. Small
/// ones are not thinned: their W_L begins far below its limit.
ComponentHistory contract_exactly(const TriMesh& scaled, const ContractionOptions& options,
                                  const RunContext& run) {
  ContractionOptions no_thinning = options;
  no_thinning.sheet_limit = options.contraction_limit;
  ComponentHistory history = contract_by(scaled, no_thinning, run.part(0.0, 0.9));
  const bool may_be_thinned =
      options.sheet_limit > options.contraction_limit && scaled.positions.size() > kProxyFrom;
  // A proxy's share of the area is not quite the same; far below the bound neither is a sheet.
  if (may_be_thinned && is_sheet(2.0 * history.shrinkage.back())) {
    const Proxy proxy = make_proxy(scaled, kMergedSize, kProxySize, run);
    const ComponentHistory coarse =
        contract_component(proxy.mesh, options, run.part(0.9, 1.0), proxy.shares);
    const std::vector<Vec3>& curve =
        is_sheet(coarse.shrinkage.back()) ? coarse.thinned : coarse.levels.back();
    for (std::size_t v = 0; v < scaled.positions.size() && !curve.empty(); ++v) {
      history.thinned.push_back(position_of(proxy.place[v], proxy.mesh, curve));
    }
    history.summary.strategy += curve.empty() ? "" : ", thinned";
  }
  return history;
}

/// Takes all steps with weights that slivers do not upset where `history` is stuck, if that leads
/// farther.
void contract_carefully(const TriMesh& scaled, const ContractionOptions& options,
                        const RunContext& run, ComponentHistory& history) {
  ContractionOptions no_thinning = options;
  no_thinning.sheet_limit = options.contraction_limit;
  ComponentHistory careful =
      contract_component(scaled, no_thinning, run, shares_of(scaled, options), true);
  if (careful.is_stuck && careful.shrinkage.back() >= history.shrinkage.back()) {
    return;
  }
  careful.summary.strategy = history.summary.strategy;
  careful.summary.remedies = history.summary.remedies;
  careful.summary.remedies.push_back(
      "so all steps were taken with weights that thin triangles do not upset");
  history = std::move(careful);
}

/// Contracts a copy of a surface with fewer vertices and evener triangles where `history` shows that
/// those of the surface itself are in the way: thin ones throw parts of it about.
void contract_even_copy(const TriMesh& scaled, const ContractionOptions& options,
                        const RunContext& run, ComponentHistory& history) {
  const auto most =
      static_cast<std::size_t>(kProxyShare * static_cast<double>(scaled.positions.size()));
  const std::size_t target = std::min(kEvenCopy, most);
  const Proxy proxy = make_proxy(scaled, target, target, run);
  if (proxy.mesh.positions.size() > most) {
    return;
  }
  ComponentHistory copy = contract_evenly(proxy.mesh, options, run, proxy.shares, true);
  if (copy.is_stuck || copy.summary.steps == 0) {
    return;
  }
  for (auto& level : copy.levels) {
    std::vector<Vec3> carried;
    carried.reserve(scaled.positions.size());
    for (const CoarsePlace& place : proxy.place) {
      carried.push_back(position_of(place, proxy.mesh, level));
    }
    level = std::move(carried);
  }
  copy.levels.front() = scaled.positions;
  copy.thinned.clear();
  copy.summary.vertices = scaled.positions.size();
  copy.summary.strategy = history.summary.strategy;
  copy.summary.remedies = history.summary.remedies;
  copy.summary.remedies.push_back("so a copy with evener triangles was contracted, of " +
                                  std::to_string(proxy.mesh.positions.size()) + " vertices");
  history = std::move(copy);
}

/// Contracts a finer copy of a surface on which `history` is stuck: coarse meshes have too few
/// vertices to move. The steps are those of the copy, of the surface's own vertices.
void contract_finer_copy(const TriMesh& scaled, const ContractionOptions& options,
                         const RunContext& run, ComponentHistory& history) {
  const TriMesh finer = refine_whole(scaled, run);
  if (finer.positions.size() == scaled.positions.size()) {
    return;
  }
  ComponentHistory copy = contract_by(finer, options, run);
  if (copy.is_stuck || copy.summary.steps <= history.summary.steps) {
    return;
  }
  for (auto& level : copy.levels) {
    level.resize(scaled.positions.size());
  }
  copy.thinned.clear();
  copy.summary.vertices = scaled.positions.size();
  copy.summary.strategy = "refined " + std::to_string(finer.positions.size());
  copy.summary.remedies.insert(copy.summary.remedies.begin(), history.summary.remedies.begin(),
                               history.summary.remedies.end());
  copy.summary.remedies.push_back("so a finer copy of the surface was contracted, of " +
                                  std::to_string(finer.positions.size()) + " vertices");
  history = std::move(copy);
}

}  // namespace

ComponentHistory contract_surface(const TriMesh& scaled, const std::optional<Proxy>& proxy,
                                  const ContractionOptions& options, const RunContext& run) {
  if (proxy) {
    ComponentHistory history = contract_by(proxy->mesh, options, run);
    history.summary.vertices = scaled.positions.size();
    history.summary.strategy = "proxy " + std::to_string(proxy->mesh.positions.size()) +
                               (history.thinned.empty() ? "" : ", thinned");
    return history;
  }
  ComponentHistory history;
  if (options.method == ContractionMethod::Exact) {
    history = contract_exactly(scaled, options, run.part(0.0, 0.7));
  } else {
    ContractionOptions no_thinning = options;
    no_thinning.sheet_limit = options.contraction_limit;
    history = contract_by(scaled, no_thinning, run.part(0.0, 0.7));
    history.summary.strategy = "direct";
  }
  if ((history.was_unsound || history.is_stuck) && options.weights == ContractionWeights::Area &&
      scaled.positions.size() >= kFewestEven) {
    contract_even_copy(scaled, options, run.part(0.7, 0.8), history);
  }
  if (history.is_stuck) {
    contract_carefully(scaled, options, run.part(0.8, 0.9), history);
  }
  if (history.is_stuck && scaled.positions.size() <= kProxyFrom) {
    contract_finer_copy(scaled, options, run.part(0.9, 1.0), history);
  }
  return history;
}

}  // namespace vantage
