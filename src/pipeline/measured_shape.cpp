// SPDX-License-Identifier: MIT
#include "vantage/pipeline/measured_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/significance/mesh_saliency.h"

#include "pipeline/describe_view.h"
#include "pipeline/measure_objective.h"
#include "pipeline/preference.h"
#include "pipeline/settled_search.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// Share of a search by a measure that the look at the set of views takes, where it was not looked at.
constexpr double kSurveyShare = 0.3;

MeasuredView measured(const FoundView& found, const MeasureObjective& by) {
  return {found.direction, by.value(found.score)};
}

/// \throw InvalidInput if only one object is to count and none of the measures asks for the map.
void require_focus_tells(const ViewOptions& options, std::span<const Measure> measures) {
  if (!options.focus.empty() && std::none_of(measures.begin(), measures.end(),
                                             [](const Measure& m) { return m.needs.kssm; })) {
    throw InvalidInput("only what sums a map can look at one object alone; leave out --focus " +
                       options.focus + ", or take --method kssm");
  }
}

}  // namespace

bool sums_a_map(std::string_view method) {
  return method == "kssm" || method == "mesh-saliency";
}

ShapeAnalysis analyse_for(const Model& model, const ViewOptions& options,
                          std::span<const Measure> measures, const RunContext& run) {
  require_focus_tells(options, measures);
  require_memory(measures, model.mesh.triangles.size());
  const bool deep = std::any_of(measures.begin(), measures.end(),
                                [](const Measure& m) { return m.needs.kssm || m.needs.skeleton; });
  return deep || !options.focus.empty()
             ? analyse_shape(model, options, run, nullptr, AnalysisUse::Map)
             : prepare_surface(model, options, run);
}

void require_area(const ShapeAnalysis& shape, const std::string& name) {
  if (!(surface_area(shape.surface) > 0.0)) {
    throw InvalidInput(name +
                       ": its surface has no area, so no view of it can be measured; kssm alone "
                       "takes points");
  }
}

MeasureSubject measure_subject(const ShapeAnalysis& shape, const ViewOptions& options) {
  MeasureSubject subject;
  subject.surface = &shape.surface;
  subject.sides = shape.sides;
  subject.camera = scoring_camera(shape, options);
  subject.weight = options.weight;
  subject.kssm = shape.significance;
  subject.saliency_options = options.saliency;
  if (const SeenBySet* seen = seen_by_set(shape, subject.camera)) {
    subject.seen_by_set = &seen->channel;
    subject.terms_of_set = seen->terms ? &*seen->terms : nullptr;
  }
  if (!shape.skeleton.graph.nodes.empty()) {
    subject.skeleton = &shape.skeleton.graph;
    subject.node_of_vertex = shape.skeleton.node_of_vertex;
  }
  return subject;
}

std::vector<double> vertex_map(const ShapeAnalysis& shape, const ViewOptions& options,
                               std::string_view name, const RunContext& run) {
  if (name == "kssm") {
    return shape.significance;
  }
  if (name == "mesh-saliency") {
    return compute_mesh_saliency(shape.surface, options.saliency, run).of_vertex;
  }
  if (name != "pmi-saliency") {
    throw InvalidInput("there is no map '" + std::string(name) +
                       "'; there are kssm, mesh-saliency, pmi-saliency");
  }
  const MeasureSubject subject = measure_subject(shape, options);
  if (subject.terms_of_set != nullptr) {
    return saliency_on_vertices(shape.surface, subject.terms_of_set->saliency_of_face);
  }
  const ViewMeasurer measurer(subject, {find_measure("pmi-saliency")}, kMeasureSetLevel, run);
  return saliency_on_vertices(shape.surface, measurer.model().terms.saliency_of_face);
}

MeasuredViews extreme_views(ViewMeasurer& measurer, std::size_t m, const SearchOptions& options,
                            const RunContext& run) {
  const Measure& measure = measurer.measure(m);
  if (options.strategy == SearchStrategy::Gradient) {
    require_gradient(measure);
  }
  const MeasureObjective by(measurer, m, run.part(0.0, kSurveyShare));
  const FoundViews found =
      search_best_and_worst(by.objective(), options, run.part(kSurveyShare, 1.0));
  return {measured(found.best, by), measured(found.worst, by),
          found.best.evaluations + found.worst.evaluations};
}

MeasuredView best_view(ViewMeasurer& measurer, std::size_t m, const RunContext& run) {
  const MeasureObjective by(measurer, m, run.part(0.0, kSurveyShare));
  return measured(search_view(by.objective(), Goal::Best, {}, run.part(kSurveyShare, 1.0)), by);
}

void require_gradient(const Measure& measure) {
  if (measure.is_count) {
    throw InvalidInput(measure.name +
                       " counts things, so it goes in steps and has no gradient to follow; use "
                       "another search, or another method");
  }
}

ViewReport find_views_by_measure(const ShapeAnalysis& shape, const FrameChoice& choice,
                                 const ViewOptions& options, const RunContext& run) {
  if (options.view_set) {
    throw InvalidInput(
        "several views are chosen by kssm or mesh-saliency only; leave out --views and "
        "--coverage, or --method " +
        options.method);
  }
  require_focus_tells(options, std::array{find_measure(options.method)});
  if (options.search.strategy == SearchStrategy::Gradient) {
    require_gradient(find_measure(options.method));
  }
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  ViewMeasurer measurer(measure_subject(shape, options), {find_measure(options.method)},
                        kMeasureSetLevel, run.part(0.0, 0.6));
  const MeasureObjective by(measurer, 0, run.part(0.0, 0.6));
  ViewObjective objective = by.objective();
  const Preference preference(shape, choice, options, objective.total.value());
  if (!preference.is_score()) {
    objective.preference = std::cref(preference);
    objective.finest_preferred_deg = std::max(objective.finest_deg, preference.finest_deg());
    objective.has_smooth_preference = preference.is_smooth();
  }
  SettledViews settled =
      search_settled(objective, preference, shape, choice.frame, options, run.part(0.6, 1.0));
  auto& [best, worst, highest] = settled.found;
  ViewReport report;
  report.twins = std::move(settled.twins);
  for (TwinView& twin : report.twins) {
    twin.score = by.value(twin.score);
  }
  report.dense_gap = settled.dense_gap;
  report.camera = scoring_camera(shape, options);
  report.up = choice.frame.up;
  report.front = choice.frame.front;
  report.total = kNone;
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, 2);
  const auto described = [&](const FoundView& found) {
    ReportedView view = describe_view(shape, *visibility, report.camera, found.direction,
                                      choice.frame.up, options, run);
    view.score = measurer.values(std::vector<Vec3>{found.direction}, run.quiet()).front().front();
    view.score_fraction = kNone;
    return view;
  };
  report.best = described(best);
  report.best.objective = best.preference;
  report.worst = described(worst);
  report.worst.objective = report.worst.score;
  compare_with_highest(report, highest.direction, by.value(highest.score),
                       measurer.measures().front().better);
  for (FoundView* found : {&best, &worst}) {
    for (SearchStep& step : found->trace) {
      step.score = by.value(step.score);
    }
  }
  report.best_search = std::move(best);
  report.worst_search = std::move(worst);
  return report;
}

}  // namespace vantage
