// SPDX-License-Identifier: MIT
#include "vantage/pipeline/find_views.h"

#include <algorithm>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/render/framing.h"

#include "pipeline/coarse_surface.h"
#include "pipeline/describe_view.h"
#include "pipeline/map_objective.h"
#include "pipeline/twins.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

/// Compares what was found with a dense search of the same objective.
DenseGap gap_to_dense(const FoundViews& found, const ViewObjective& objective,
                      const RunContext& run) {
  const FoundViews dense =
      search_best_and_worst(objective, {.strategy = SearchStrategy::Dense}, run);
  double highest = dense.best.score;
  for (const SearchStep& step : dense.best.trace) {
    highest = std::max(highest, step.score);
  }
  DenseGap gap;
  gap.evaluations = dense.best.evaluations + dense.worst.evaluations;
  if (dense.best.preference > 0.0) {
    gap.best_ratio = found.best.preference / dense.best.preference;
  }
  if (highest > dense.worst.score) {
    gap.worst_above = (found.worst.score - dense.worst.score) / (highest - dense.worst.score);
  }
  return gap;
}

/// Of the best view and what mirror planes make of it, the one most toward the front.
void settle_on_the_front(FoundView& best, std::vector<TwinView>& twins, const UprightFrame& frame) {
  TwinView first{best.direction, best.score, best.preference};
  settle_near_ties(first, twins, frame);
  best.direction = first.direction;
  best.score = first.score;
  best.preference = first.objective;
}

}  // namespace

ViewReport find_views(const ShapeAnalysis& shape, const ModelFrame& model_frame,
                      const ViewOptions& options, const RunContext& run) {
  check_fields(options, kViewFields);
  if (!sums_a_map(options.method)) {
    return find_views_by_measure(shape, model_frame, options, run);
  }
  ViewReport report;
  report.camera = scoring_camera(shape, options);
  report.up = model_frame.up;
  report.front = model_frame.front;
  const MapObjective map(shape, options, run);
  const ViewScorer& scorer = map.scorer();
  report.total = scorer.total();
  if (!(report.total > 0.0)) {
    report.warnings.emplace_back(
        "the significance map is zero everywhere, so every view is as good as any other");
  }
  const UprightFrame frame = upright_frame(model_frame);
  const ViewObjective objective = map.objective(frame);
  const double search_share = options.view_set || options.certify ? 0.25 : 1.0;  // of the bar
  FoundViews found = search_best_and_worst(objective, options.search, run.part(0.0, search_share));
  auto& [best, worst] = found;
  report.twins = twins_of(best.direction, shape, scorer, options.prior, frame);
  if (!options.prior.is_uniform) {
    settle_on_the_front(best, report.twins, frame);
  }
  if (options.certify) {  // what is reported, and so not before near-ties are settled
    report.dense_gap =
        gap_to_dense(found, objective, run.part(search_share, options.view_set ? 0.6 : 1.0));
  }
  const auto described = [&](const FoundView& view) {
    return describe_scored_view(shape, map.visibility(), scorer, view.direction, model_frame,
                                options);
  };
  report.best = described(best);
  report.worst = described(worst);
  report.worst.objective = report.worst.score;  // no prior has a say in it
  if (options.view_set) {
    report.set =
        find_view_set(shape, map.visibility(), scorer, best.direction, model_frame, options,
                      report.warnings, run.part(options.certify ? 0.6 : search_share, 1.0));
  }
  report.best_search = std::move(best);
  report.worst_search = std::move(worst);
  return report;
}

ViewReport find_views(const ShapeAnalysis& shape, const FrameChoice& choice,
                      const ViewOptions& options, const RunContext& run) {
  ViewReport report = find_views(shape, choice.frame, options, run);
  report.orientation = choice.orientation;
  report.warnings.insert(report.warnings.end(), choice.notes.begin(), choice.notes.end());
  return report;
}

ReportedView find_view(const ShapeAnalysis& shape, Goal goal, const FrameChoice& choice,
                       const ViewOptions& options, const RunContext& run) {
  check_fields(options, kViewFields);
  if (!sums_a_map(options.method)) {
    const ViewReport both = find_views_by_measure(shape, choice.frame, options, run);
    return goal == Goal::Best ? both.best : both.worst;
  }
  const MapObjective map(shape, options, run);
  const UprightFrame frame = upright_frame(choice.frame);
  FoundView found = search_view(map.objective(frame), goal, options.search, run);
  if (goal == Goal::Best && !options.prior.is_uniform) {
    std::vector<TwinView> twins =
        twins_of(found.direction, shape, map.scorer(), options.prior, frame);
    settle_on_the_front(found, twins, frame);
  }
  ReportedView view = describe_scored_view(shape, map.visibility(), map.scorer(), found.direction,
                                           choice.frame, options);
  view.objective = goal == Goal::Best ? view.objective : view.score;
  return view;
}

PictureView find_picture_view(const Model& model, const ShapeAnalysis& prepared,
                              const ViewOptions& options, const RunContext& run) {
  constexpr std::size_t kLarge = 200'000;  // vertices [ours]
  ShapeAnalysis surface = prepared;
  const bool is_large = !prepared.cloud && prepared.surface.positions.size() > kLarge;
  if (is_large) {
    CoarseSurface coarse =
        coarse_surface(prepared.surface, prepared.sides, kLarge / 2, run.part(0.0, 0.3));
    surface.surface = std::move(coarse.mesh);
    surface.sides = std::move(coarse.sides);
  }
  const ShapeAnalysis shape = analyse_surface(std::move(surface), options, run.part(0.3, 0.8));
  PictureView found;
  // By the surface as it is: all commands answer alike.
  found.choice = choose_frame(model, is_large ? prepared : shape, options);
  found.view = find_view(shape, Goal::Best, found.choice, options, run.part(0.8, 1.0));
  found.vertices = shape.surface.positions.size();
  if (is_large) {
    found.view.picture = framed(prepared, found.view.direction, found.choice.frame.up, options);
  }
  return found;
}

}  // namespace vantage
