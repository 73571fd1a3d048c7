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

// A surface that cannot be decimated to this share of its vertices gains nothing by a coarse copy,
// and if it is large, its own is looked at for some vertices: so many, that stand for those after
// them. [ours]
constexpr std::size_t kWorthwhile = 2;
constexpr std::size_t kLarge = 16'000;
constexpr std::size_t kSampled = 1000;

bool is_worthwhile(const CoarseSurface& coarse) {
  const std::size_t vertices = coarse.of_vertex.size();
  return vertices > 0 && kWorthwhile * coarse.mesh.positions.size() <= vertices;
}

bool is_sampled(const CoarseSurface& coarse) {
  return !is_worthwhile(coarse) && coarse.of_vertex.size() >= kLarge;
}

/// What the vertices that are looked at for an estimate add to it.
std::vector<double> estimated_shares(const CoarseSurface& coarse,
                                     const std::vector<double>& shares) {
  if (!is_sampled(coarse)) {
    return coarse.sums(shares);
  }
  std::vector<double> sampled(shares.size(), 0.0);
  const std::size_t step = shares.size() / kSampled;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    sampled[v - v % step] += shares[v];
  }
  return sampled;
}

}  // namespace

MapObjective::MapObjective(const ShapeAnalysis& shape, const ViewOptions& options,
                           const RunContext& run)
    : prepared_(preparation_of(shape)),
      quiet_{.stop = run.stop, .max_threads = run.max_threads},
      faces_(faces_to_score(shape, options)),
      scorer_(faces_ ? ViewScorer(*faces_, shape.map.of_vertex, scoring_camera(shape, options))
                     : ViewScorer(prepared_->visibility, shape.map.of_vertex,
                                  scoring_camera(shape, options))),
      proxy_shares_(prepared_->proxy.sums(vertex_shares(shape, options.weight))),
      proxy_scorer_(prepared_->proxy_visibility, proxy_shares_, scoring_camera(shape, options)),
      coarse_shares_(estimated_shares(prepared_->coarse, vertex_shares(shape, options.weight))),
      coarse_scorer_(
          is_sampled(prepared_->coarse) ? prepared_->visibility : prepared_->coarse_visibility,
          coarse_shares_, scoring_camera(shape, options)) {}

ViewObjective MapObjective::objective(const Preference& preference) const {
  ViewObjective objective;
  objective.total = scorer_.total();
  if (is_sampled(prepared_->coarse)) {
    objective.survey_level = 3;  // a look costs ten times as much as at surfaces of one skin
  }
  objective.score = [this](const std::vector<Vec3>& directions) {
    return scorer_.score_all(directions, quiet_);
  };
  if (is_worthwhile(prepared_->coarse) || is_sampled(prepared_->coarse) || faces_) {
    objective.surrogate = [this](const std::vector<Vec3>& directions) {
      return estimates(directions);
    };
  }
  // By area the score is an integral over faces, which the proxy's vertices are too few to follow.
  if (!faces_ && is_worthwhile(prepared_->proxy)) {
    objective.proxy = [this](const std::vector<Vec3>& directions) {
      return proxy_scorer_.score_all(directions, quiet_);
    };
  }
  if (!preference.is_score()) {
    objective.finest_preferred_deg = preference.finest_deg();
    objective.preference = [&preference](const Vec3& direction, double score) {
      return preference(direction, score);
    };
  }
  return objective;
}

}  // namespace vantage
