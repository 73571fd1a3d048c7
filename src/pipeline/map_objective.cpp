// SPDX-License-Identifier: MIT
#include "pipeline/map_objective.h"

#include "vantage/pipeline/find_views.h"

namespace vantage {
namespace {

// The fewer vertices a surface has the narrower are the peaks and pits of its score, and the sooner all
// views of a finer set are scored: at most so many vertices. [ours]
constexpr std::size_t kFewVertices = 500;
constexpr int kFineLevel = 5;
// Of ascents where there is no proxy: small surfaces have the narrower maxima, and are soon done. [ours]
constexpr std::size_t kManyStarts = 16;

/// What each vertex adds to a score that sees it: its significance, or by area that of its third of
/// the faces there over the whole area, the integral of the map wherever a face is seen whole.
/// \param areas of the vertices.
std::vector<double> vertex_shares(const ShapeAnalysis& shape, const std::vector<double>& areas,
                                  Weight weight) {
  std::vector<double> shares = shape.significance;
  if (weight == Weight::Area) {
    const double whole = surface_area(shape.surface);
    for (std::size_t v = 0; v < shares.size(); ++v) {
      shares[v] *= whole > 0.0 ? areas[v] / whole : 0.0;
    }
  }
  return shares;
}

/// Whether a surface without a coarse copy is so large that an estimate looks at as many of its
/// vertices as the copy would have, each for those after it.
bool is_sampled(const ViewPreparation& prepared) {
  return !prepared.is_coarse() && prepared.coarse.of_vertex.size() > ViewPreparation::kLargeSurface;
}

/// What the vertices that are looked at for an estimate add to it.
std::vector<double> estimated_shares(const ViewPreparation& prepared,
                                     const std::vector<double>& shares) {
  if (!is_sampled(prepared)) {
    return prepared.coarse.sums(shares);
  }
  std::vector<double> sampled(shares.size(), 0.0);
  const std::size_t step = shares.size() / ViewPreparation::kCoarseVertices;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    sampled[v - v % step] += shares[v];
  }
  return sampled;
}

}  // namespace

MapScorer::MapScorer(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                     const ViewOptions& options)
    : faces_(options.weight == Weight::Area
                 ? std::optional<FaceVisibility>(std::in_place, shape.surface, shape.sides)
                 : std::nullopt),
      scorer_(faces_ ? ViewScorer(*faces_, shape.significance, scoring_camera(shape, options))
                     : ViewScorer(visibility, shape.significance, scoring_camera(shape, options))) {
}

MapObjective::MapObjective(const ShapeAnalysis& shape, const ViewOptions& options,
                           const RunContext& run)
    : prepared_(preparation_of(shape, run.quiet())),
      quiet_(run.quiet()),
      by_map_(shape, prepared_->visibility, options),
      shares_(vertex_shares(shape, prepared_->vertex_areas, options.weight)),
      proxy_shares_(prepared_->proxy.sums(shares_)),
      proxy_scorer_(prepared_->proxy_visibility, proxy_shares_, scoring_camera(shape, options)),
      coarse_shares_(estimated_shares(*prepared_, shares_)),
      coarse_scorer_(is_sampled(*prepared_) ? prepared_->visibility : prepared_->coarse_visibility,
                     coarse_shares_, scoring_camera(shape, options)) {}

std::vector<double> MapObjective::estimates(const std::vector<Vec3>& directions) const {
  const std::optional<SurveySight>& survey = prepared_->survey;
  if (!survey || !is_same(survey->camera(), coarse_scorer_.camera())) {
    return coarse_scorer_.score_all(directions, quiet_);
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
  const std::vector<double> of_others = coarse_scorer_.score_all(others, quiet_);
  for (std::size_t k = 0; k < index.size(); ++k) {
    scores[index[k]] = of_others[k];
  }
  return scores;
}

ViewObjective MapObjective::objective(const Preference& preference) const {
  ViewObjective objective;
  objective.total = scorer().total();
  objective.score = [this](const std::vector<Vec3>& directions) {
    return scorer().score_all(directions, quiet_);
  };
  const bool is_by_area = scorer().faces() != nullptr;
  if (is_sampled(*prepared_)) {
    objective.survey_level = 3;  // a look costs ten times as much as at surfaces of one skin
  } else if (!is_by_area && !prepared_->has_proxy()) {
    objective.starts = kManyStarts;
  }
  if (prepared_->is_coarse() || is_sampled(*prepared_) || is_by_area) {
    objective.surrogate = [this](const std::vector<Vec3>& directions) {
      return estimates(directions);
    };
  } else if (prepared_->vertex_areas.size() <= kFewVertices) {
    objective.survey_level = kFineLevel;
  }
  // By area the score is an integral over faces, which the proxy's vertices are too few to follow.
  if (!is_by_area && prepared_->has_proxy()) {
    objective.proxy = [this](const std::vector<Vec3>& directions) {
      return proxy_scorer_.score_all(directions, quiet_);
    };
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

}  // namespace vantage
