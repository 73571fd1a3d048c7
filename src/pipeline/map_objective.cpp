// SPDX-License-Identifier: MIT
#include "pipeline/map_objective.h"

#include "vantage/pipeline/find_views.h"

#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// The fewer vertices a surface has the narrower are the peaks and pits of its score, and the sooner all
// views of a finer set are scored: at most so many vertices. [ours]
constexpr std::size_t kFewVertices = 500;
constexpr int kFineLevel = 5;
// Of ascents where there is no proxy: small surfaces have the narrower maxima, and are soon done. [ours]
constexpr std::size_t kManyStarts = 16;

}  // namespace

MapScorer::MapScorer(const ShapeAnalysis& shape, std::span<const double> map,
                     const VertexVisibility& visibility, const ViewOptions& options)
    : faces_(options.weight == Weight::Area
                 ? std::optional<FaceVisibility>(std::in_place, shape.surface, shape.sides)
                 : std::nullopt),
      scorer_(faces_ ? ViewScorer(*faces_, map, scoring_camera(shape, options))
                     : ViewScorer(visibility, map, scoring_camera(shape, options))) {}

MapObjective::MapObjective(const ShapeAnalysis& shape, std::span<const double> map,
                           const ViewOptions& options, const RunContext& run)
    : visibility_(visibility_of(shape, ViewPreparation::kEyes)),
      quiet_(run.quiet()),
      by_map_(shape, map, *visibility_, options),
      is_small_(shape.surface.positions.size() <= kFewVertices) {
  if (options.search.strategy == SearchStrategy::Global) {
    estimates_.emplace(shape, map, options, quiet_);
  }
}

ViewObjective MapObjective::objective(const Preference& preference) const {
  ViewObjective objective;
  objective.total = scorer().total();
  objective.score = [this](const std::vector<Vec3>& directions) {
    return scorer().score_all(directions, quiet_);
  };
  if (estimates_) {
    add_estimates(objective);
  }
  if (!preference.is_score()) {
    objective.finest_preferred_deg = preference.finest_deg();
    objective.has_smooth_preference = preference.is_smooth();
    objective.preference = [&preference](const Vec3& direction, double score) {
      return preference(direction, score);
    };
  }
  return objective;
}

void MapObjective::add_estimates(ViewObjective& objective) const {
  const CoarseCopies& copies = estimates_->copies();
  const bool is_by_area = scorer().faces() != nullptr;
  objective.survey_level = copies.survey_level();
  const bool is_large = copies.coarse.of_vertex.size() > CoarseCopies::kLargeSurface;
  if (!(copies.is_sampled() && is_large) && !is_by_area && !copies.has_proxy()) {
    objective.starts = kManyStarts;
  }
  if (estimates_->are_sooner()) {
    objective.surrogate = [this](const std::vector<Vec3>& directions) {
      return estimates_->scores(directions);
    };
  } else if (is_small_) {
    objective.survey_level = kFineLevel;
  }
  // By area the score is an integral over faces, which the proxy's vertices are too few to follow.
  if (!is_by_area && copies.has_proxy()) {
    objective.proxy = [this](const std::vector<Vec3>& directions) {
      return estimates_->proxy_scores(directions);
    };
  }
}

}  // namespace vantage
