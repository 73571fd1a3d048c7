// SPDX-License-Identifier: MIT
#include "pipeline/map_estimates.h"

#include <optional>

#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"

#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

/// What each vertex adds to a score that sees it: its value, or by area that of its third of
/// the faces there over the whole area, the integral of the map wherever a face is seen whole.
std::vector<double> vertex_shares(const ShapeAnalysis& shape, std::span<const double> map,
                                  Weight weight) {
  std::vector<double> shares(map.begin(), map.end());
  if (weight == Weight::Area) {
    const std::vector<double> areas =
        shape.views ? shape.views->vertex_areas : vertex_areas(shape.surface);
    const double whole = surface_area(shape.surface);
    for (std::size_t v = 0; v < shares.size(); ++v) {
      shares[v] *= whole > 0.0 ? areas[v] / whole : 0.0;
    }
  }
  return shares;
}

/// What the vertices that are looked at for an estimate add to it: those of the coarse copy, or as many of
/// a surface that cannot be made coarser, each for those after it.
std::vector<double> estimated_shares(const CoarseCopies& copies,
                                     const std::vector<double>& shares) {
  if (!copies.is_sampled()) {
    return copies.coarse.sums(shares);
  }
  std::vector<double> sampled(shares.size(), 0.0);
  const std::size_t step = shares.size() / CoarseCopies::kCoarseVertices;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    sampled[v - v % step] += shares[v];
  }
  return sampled;
}

}  // namespace

MapEstimates::MapEstimates(const ShapeAnalysis& shape, std::span<const double> map,
                           const ViewOptions& options, const RunContext& run)
    : quiet_(run.quiet()),
      is_by_area_(options.weight == Weight::Area),
      copies_(copies_of(shape, quiet_)),
      looked_at_(copies_->is_sampled() ? visibility_of(shape, ViewPreparation::kEyes)
                                       : std::shared_ptr<const VertexVisibility>(
                                             copies_, &copies_->coarse_visibility)) {
  const std::vector<double> shares = vertex_shares(shape, map, options.weight);
  const ScoringCamera camera = scoring_camera(shape, options);
  proxy_shares_ = copies_->proxy.sums(shares);
  proxy_scorer_.emplace(copies_->proxy_visibility, proxy_shares_, camera);
  coarse_shares_ = estimated_shares(*copies_, shares);
  coarse_scorer_.emplace(*looked_at_, coarse_shares_, camera);
}

std::vector<double> MapEstimates::scores(const std::vector<Vec3>& directions) const {
  const std::optional<SurveySight>& survey = copies_->survey;
  if (!survey || !is_same(survey->camera(), coarse_scorer_->camera())) {
    return coarse_scorer_->score_all(directions, quiet_);
  }
  std::vector<double> scores(directions.size(), 0.0);
  std::vector<Vec3> others;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (const auto score = survey->score(directions[i], coarse_shares_)) {
      scores[i] = *score;
    } else {
      others.push_back(directions[i]);
      index.push_back(i);
    }
  }
  const std::vector<double> of_others = coarse_scorer_->score_all(others, quiet_);
  for (std::size_t k = 0; k < index.size(); ++k) {
    scores[index[k]] = of_others[k];
  }
  return scores;
}

std::vector<double> MapEstimates::proxy_scores(const std::vector<Vec3>& directions) const {
  return proxy_scorer_->score_all(directions, quiet_);
}

}  // namespace vantage
