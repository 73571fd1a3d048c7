// SPDX-License-Identifier: MIT
#include "pipeline/map_objective.h"

#include "vantage/pipeline/find_views.h"

namespace vantage {
namespace {

/// What each vertex adds to a score that sees it: its significance, or by area that of its third of
/// the faces there over the whole area, the integral of the map wherever a face is seen whole.
std::vector<double> vertex_shares(const ShapeAnalysis& shape, Weight weight) {
  std::vector<double> shares = shape.map.of_vertex;
  if (weight == Weight::Area) {
    const std::vector<double> areas = vertex_areas(shape.surface);
    const double whole = surface_area(shape.surface);
    for (std::size_t v = 0; v < shares.size(); ++v) {
      shares[v] *= whole > 0.0 ? areas[v] / whole : 0.0;
    }
  }
  return shares;
}

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
