// SPDX-License-Identifier: MIT
#include "vantage/report/view_report.h"

#include <algorithm>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/render/framing.h"
#include "vantage/report/measured_shape.h"
#include "vantage/view/landmarks.h"

#include "core/parallel.h"
#include "report/prior_search.h"
#include "report/scored_view.h"
#include "report/twins.h"
#include "report/vertex_share.h"
#include "report/view_preparation.h"
#include "view/nearby_scorer.h"
#include "view/sketch_scorer.h"

namespace vantage {
namespace {

/// \param areas of the vertices.
double visible_area_fraction(std::span<const double> areas, std::span<const std::uint8_t> visible) {
  double seen = 0.0;
  double all = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    all += areas[v];
    seen += visible[v] != 0 ? areas[v] : 0.0;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace

std::optional<FaceVisibility> faces_to_score(const ShapeAnalysis& shape,
                                             const ViewOptions& options) {
  std::optional<FaceVisibility> faces;
  if (options.weight == Weight::Area) {
    faces.emplace(shape.surface, shape.sides);
  }
  return faces;
}

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

ScoringCamera scoring_camera(const ShapeAnalysis& shape, const ViewOptions& options) {
  return {.sphere = shape.sphere,
          .projection = options.projection,
          .fov_y_deg = options.fov_y_deg,
          .distance_factor = options.distance_factor};
}

ReportedView describe_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                           const ScoringCamera& camera, const Vec3& direction, UpAxis up,
                           const ViewOptions& options) {
  const auto visible = visibility.visible_vertices(camera.viewpoint(direction));
  double total = 0.0;
  for (const double value : shape.map.of_vertex) {
    total += value;
  }
  ReportedView view;
  view.direction = direction;
  view.eye = camera.eye(direction);
  view.up = upright(direction, up_vector(up));
  view.score = visible_sum(shape.map.of_vertex, visible);
  view.score_fraction = total > 0.0 ? view.score / total : 0.0;
  view.objective = view.score;
  const ViewPreparation* views = views_of(shape);
  view.visible_area_fraction = visible_area_fraction(
      views != nullptr ? views->vertex_areas : vertex_areas(shape.surface), visible);
  view.picture = frame_points(referenced_points(shape.surface), camera.viewpoint(direction),
                              camera.sphere.centre, up_vector(up),
                              static_cast<double>(options.width) / options.height,
                              options.margin_percent / 100.0);
  return view;
}

ReportedView describe_scored_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                                  const ViewScorer& scorer, const Vec3& direction, UpAxis up,
                                  const ViewOptions& options) {
  ReportedView view = describe_view(shape, visibility, scorer.camera(), direction, up, options);
  if (options.weight == Weight::Area) {
    view.score = scorer.score(direction);
    view.score_fraction = scorer.total() > 0.0 ? view.score / scorer.total() : 0.0;
  }
  view.objective = view.score * options.prior.factor(upright_frame(up_vector(up)), direction);
  return view;
}

namespace {

/// Compares what was found with a dense search of the same objective.
DenseGap gap_to_dense(const FoundViews& found, const ScoreBatch& score, double total,
                      const ViewPrior& prior, const UprightFrame& frame, const RunContext& run) {
  const FoundViews dense =
      search_under_prior(score, total, prior, frame, {.strategy = SearchStrategy::Dense}, run);
  const auto objective = [&](const FoundView& view) {
    return view.score * prior.factor(frame, view.direction);
  };
  double highest = dense.best.score;
  for (const SearchStep& step : dense.best.trace) {
    highest = std::max(highest, step.score);
  }
  DenseGap gap;
  gap.evaluations = dense.best.evaluations + dense.worst.evaluations;
  if (objective(dense.best) > 0.0) {
    gap.best_ratio = objective(found.best) / objective(dense.best);
  }
  if (highest > dense.worst.score) {
    gap.worst_above = (found.worst.score - dense.worst.score) / (highest - dense.worst.score);
  }
  return gap;
}

// A model of very few vertices is looked over by its scores. [ours, docs/search.md]
constexpr std::size_t kEstimatedFrom = 500;

}  // namespace

ViewReport find_views(const ShapeAnalysis& shape, UpAxis up, const ViewOptions& options,
                      const RunContext& run) {
  check_fields(options, kViewFields);
  if (!sums_a_map(options.method)) {
    return find_views_by_measure(shape, up, options, run);
  }
  ViewReport report;
  report.camera = scoring_camera(shape, options);
  report.up = up;
  const std::shared_ptr<const ViewPreparation> prepared = preparation_of(shape);
  const VertexVisibility& visibility = prepared->visibility;
  const std::optional<FaceVisibility> faces = faces_to_score(shape, options);
  const ViewScorer scorer = faces ? ViewScorer(*faces, shape.map.of_vertex, report.camera)
                                  : ViewScorer(visibility, shape.map.of_vertex, report.camera);
  report.total = scorer.total();
  if (!(report.total > 0.0)) {
    report.warnings.emplace_back(
        "the significance map is zero everywhere, so every view is as good as any other");
  }
  // Progress belongs to the search as a whole: the batches only listen for a stop.
  RunContext batch_run = run;
  batch_run.report = nullptr;
  const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
    return scorer.score_all(directions, batch_run);
  };
  ScoreBatch remembered = score;
  SearchHints hints;
  std::optional<SketchScorer> sketch;
  NearbyScorer amid(visibility, shape.map.of_vertex, report.camera);
  if (options.search.strategy == SearchStrategy::Global) {
    if (!faces) {
      remembered = [&](const std::vector<Vec3>& directions) {
        return amid.score_all(directions, batch_run);
      };
      hints.nearby = [&](const Circles& circles, const std::vector<Vec3>& directions) {
        return amid.score_amid(circles, directions, batch_run);
      };
      hints.expect_nearby = [&](const std::vector<Circles>& circles) {
        amid.expect(circles, batch_run);
      };
    }
    hints.landmarks = prepared->landmarks;
    hints.brinks = brink_directions(prepared->walls, report.camera);
    const std::size_t size = shape.surface.positions.size();
    hints.scores_are_cheap = size < kCheapBelow;
    if (size >= (faces ? kCheapBelow : kEstimatedFrom)) {
      sketch.emplace(shape.surface, shape.sides, vertex_shares(shape, options.weight),
                     report.camera, sketch_options(size), prepared->coarse);
      hints.estimate = [&](const std::vector<Vec3>& directions) {
        return sketch->score_all(directions, batch_run);
      };
    }
  }
  const double search_share = options.view_set || options.certify ? 0.25 : 1.0;  // of the bar
  const UprightFrame frame = upright_frame(up_vector(up));
  FoundViews found = search_under_prior(remembered, report.total, options.prior, frame,
                                        options.search, run.part(0.0, search_share), hints);
  auto& [best, worst] = found;
  report.twins = twins_of(best.direction, shape, scorer, options.prior, frame);
  if (!options.prior.is_uniform) {
    TwinView first{best.direction, best.score,
                   best.score * options.prior.factor(frame, best.direction)};
    settle_near_ties(first, report.twins, frame);
    best.direction = first.direction;
    best.score = first.score;
  }
  if (options.certify) {  // what is reported, and so not before near-ties are settled
    report.dense_gap = gap_to_dense(found, score, report.total, options.prior, frame,
                                    run.part(search_share, options.view_set ? 0.6 : 1.0));
  }
  const auto described = [&](const FoundView& view) {
    return describe_scored_view(shape, visibility, scorer, view.direction, up, options);
  };
  run_both(
      batch_run, [&, &best = best] { report.best = described(best); },
      [&, &worst = worst] { report.worst = described(worst); });
  report.worst.objective = report.worst.score;  // no prior has a say in it
  if (options.view_set) {
    report.set =
        find_view_set(shape, visibility, scorer, best.direction, up, options, report.warnings,
                      run.part(options.certify ? 0.6 : search_share, 1.0));
  }
  report.best_search = std::move(best);
  report.worst_search = std::move(worst);
  return report;
}

ViewReport find_views(const ShapeAnalysis& shape, const UpChoice& up, const ViewOptions& options,
                      const RunContext& run) {
  ViewReport report = find_views(shape, up.axis, options, run);
  report.up_source = up.source;
  if (!up.note.empty()) {
    report.warnings.push_back(up.note);
  }
  return report;
}

}  // namespace vantage
