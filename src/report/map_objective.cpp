// SPDX-License-Identifier: MIT
#include "report/map_objective.h"

#include "report/vertex_share.h"

namespace vantage {
namespace {

// A surface that cannot be decimated to this share of its vertices gains nothing by estimates.
constexpr std::size_t kWorthwhile = 2;

}  // namespace

MapObjective::MapObjective(const ShapeAnalysis& shape, const ViewOptions& options,
                           const RunContext& run)
    : prepared_(preparation_of(shape)),
      quiet_{.stop = run.stop, .max_threads = run.max_threads},
      prior_(options.prior),
      faces_(faces_to_score(shape, options)),
      scorer_(faces_ ? ViewScorer(*faces_, shape.map.of_vertex, scoring_camera(shape, options))
                     : ViewScorer(prepared_->visibility, shape.map.of_vertex,
                                  scoring_camera(shape, options))),
      coarse_shares_(prepared_->coarse.sums(vertex_shares(shape, options.weight))),
      coarse_scorer_(prepared_->coarse_visibility, coarse_shares_, scoring_camera(shape, options)) {
}

ViewObjective MapObjective::objective(const UprightFrame& frame) const {
  ViewObjective objective;
  objective.total = scorer_.total();
  objective.score = [this](const std::vector<Vec3>& directions) {
    return scorer_.score_all(directions, quiet_);
  };
  const std::size_t size = prepared_->coarse.of_vertex.size();
  const std::size_t coarse = prepared_->coarse.mesh.positions.size();
  if (kWorthwhile * coarse <= size || faces_) {
    objective.surrogate = [this](const std::vector<Vec3>& directions) {
      return estimates(directions);
    };
  }
  if (!prior_.is_uniform) {
    objective.preference = [this, frame](const Vec3& direction, double score) {
      return score * prior_.factor(frame, direction);
    };
  }
  return objective;
}

}  // namespace vantage
