// SPDX-License-Identifier: MIT
#include "vantage/report/measured_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/significance/mesh_saliency.h"

#include "report/prior_search.h"
#include "report/view_preparation.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// Rings around a view of the set, whose directions are about 9° apart at level 3. [ours]
constexpr double kFirstRingRad = 4.0 * kRadPerDeg;
constexpr double kLastRingRad = 1.0 * kRadPerDeg;

/// Values of any directions as scores that grow with how good the view is, at least 0.
class GrowingScore {
 public:
  GrowingScore(ViewMeasurer& measurer, const RunContext& run) : measurer_(&measurer), run_(run) {
    run_.report = nullptr;
    const std::vector<double>& values = measurer.set_values(run_).front();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vec3& d = measurer.set().directions[i];
      of_set_[{d.x(), d.y(), d.z()}] = values[i];
      highest_ = std::isfinite(values[i]) ? std::max(highest_, values[i]) : highest_;
    }
  }

  [[nodiscard]] double highest() const { return std::max(highest_, 0.0); }

  [[nodiscard]] bool is_falling() const {
    return measurer_->measures().front().better == Better::Less;
  }

  std::vector<double> operator()(const std::vector<Vec3>& directions) const {
    std::vector<double> scores(directions.size(), 0.0);
    std::vector<Vec3> fresh;
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Vec3& d = directions[i];
      const auto known = of_set_.find({d.x(), d.y(), d.z()});
      if (known != of_set_.end()) {
        scores[i] = score(known->second);
      } else {
        fresh.push_back(d);
        place.push_back(i);
      }
    }
    const MeasureValues values = measurer_->values(fresh, run_);
    for (std::size_t k = 0; k < fresh.size(); ++k) {
      scores[place[k]] = score(values.front()[k]);
    }
    return scores;
  }

  [[nodiscard]] double score(double value) const {
    return is_falling() ? std::max(0.0, highest() - value) : value;
  }

 private:
  ViewMeasurer* measurer_;
  RunContext run_;
  std::map<std::array<double, 3>, double> of_set_{};
  double highest_ = -std::numeric_limits<double>::infinity();
};

/// Climbs from a view by smaller and smaller rings.
MeasuredView climbed(const ViewMeasurer& measurer, std::size_t m, MeasuredView view, Goal goal,
                     std::size_t& evaluations, const RunContext& run) {
  const Measure& measure = measurer.measures()[m];
  for (double step = kFirstRingRad; step >= kLastRingRad; step *= 0.5) {
    const std::vector<Vec3> ring = ring_around(view.direction, step);
    const std::vector<double> values = measurer.values_of(m, ring, run);
    evaluations += ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const bool moves = goal == Goal::Best ? measure.is_better(values[i], view.value)
                                            : measure.is_better(view.value, values[i]);
      if (moves) {
        view = {ring[i], values[i]};
      }
    }
  }
  return view;
}

}  // namespace

bool sums_a_map(std::string_view method) {
  return method == "kssm" || method == "mesh-saliency";
}

ShapeAnalysis analyse_for(const Model& model, const ViewOptions& options,
                          std::span<const Measure> measures, const RunContext& run) {
  const bool deep = std::any_of(measures.begin(), measures.end(),
                                [](const Measure& m) { return m.needs.kssm || m.needs.skeleton; });
  return deep || !options.focus.empty()
             ? analyse_shape(model, options, run, nullptr, AnalysisUse::Map)
             : prepare_surface(model, run);
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
  subject.kssm = shape.map.of_vertex;
  if (!shape.skeleton.graph.nodes.empty()) {
    subject.skeleton = &shape.skeleton.graph;
    subject.node_of_vertex = shape.skeleton.node_of_vertex;
  }
  return subject;
}

std::vector<double> vertex_map(const ShapeAnalysis& shape, const ViewOptions& options,
                               std::string_view name, const RunContext& run) {
  if (name == "kssm") {
    return shape.map.of_vertex;
  }
  if (name == "mesh-saliency") {
    return compute_mesh_saliency(shape.surface, options.saliency, run).of_vertex;
  }
  if (name != "pmi-saliency") {
    throw InvalidInput("there is no map '" + std::string(name) +
                       "'; there are kssm, mesh-saliency, pmi-saliency");
  }
  constexpr int kLevel = 3;
  const ViewMeasurer measurer(measure_subject(shape, options), {find_measure("pmi-saliency")},
                              kLevel, run);
  return saliency_on_vertices(shape.surface, measurer.model().terms.saliency_of_face);
}

namespace {

/// The best, or the worst, view of the set, climbed from.
MeasuredView extreme_view(ViewMeasurer& measurer, std::size_t m, Goal goal,
                          std::size_t& evaluations, const RunContext& run) {
  const std::vector<double>& values = measurer.set_values(run)[m];
  const Measure& measure = measurer.measures()[m];
  std::size_t found = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const bool is_farther = goal == Goal::Best ? measure.is_better(values[i], values[found])
                                               : measure.is_better(values[found], values[i]);
    found = is_farther ? i : found;
  }
  RunContext quiet = run;
  quiet.report = nullptr;
  return climbed(measurer, m, {measurer.set().directions[found], values[found]}, goal, evaluations,
                 quiet);
}

}  // namespace

MeasuredViews extreme_views(ViewMeasurer& measurer, std::size_t m, const RunContext& run) {
  MeasuredViews views;
  views.best = extreme_view(measurer, m, Goal::Best, views.evaluations, run);
  views.worst = extreme_view(measurer, m, Goal::Worst, views.evaluations, run);
  return views;
}

MeasuredView best_view(ViewMeasurer& measurer, std::size_t m, const RunContext& run) {
  std::size_t evaluations = 0;
  return extreme_view(measurer, m, Goal::Best, evaluations, run);
}

MeasuredViews gradient_views(const ViewMeasurer& measurer, std::size_t m,
                             const SearchOptions& options, const RunContext& run) {
  const Measure& measure = measurer.measures()[m];
  require_gradient(measure);
  RunContext quiet = run;
  quiet.report = nullptr;
  const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
    return measurer.values_of(m, directions, quiet);
  };
  const bool rises = measure.better == Better::More;
  SearchOptions by_gradient = options;
  by_gradient.strategy = SearchStrategy::Gradient;
  constexpr double kTotal = 1.0;  // there is something to find; its size does not matter here
  const FoundView best =
      search_view(score, kTotal, rises ? Goal::Best : Goal::Worst, by_gradient, quiet);
  const FoundView worst =
      search_view(score, kTotal, rises ? Goal::Worst : Goal::Best, by_gradient, quiet);
  return {{best.direction, best.score},
          {worst.direction, worst.score},
          best.evaluations + worst.evaluations};
}

void require_gradient(const Measure& measure) {
  if (measure.is_count) {
    throw InvalidInput(measure.name +
                       " counts things, so it goes in steps and has no gradient to follow; use "
                       "another search, or another method");
  }
}

ViewReport find_views_by_measure(const ShapeAnalysis& shape, UpAxis up, const ViewOptions& options,
                                 const RunContext& run) {
  if (options.view_set) {
    throw InvalidInput(
        "several views are chosen by kssm or mesh-saliency only; leave out --views and "
        "--coverage, or --method " +
        options.method);
  }
  if (options.search.strategy == SearchStrategy::Gradient) {
    require_gradient(find_measure(options.method));
  }
  constexpr int kLevel = 3;
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  ViewMeasurer measurer(measure_subject(shape, options), {find_measure(options.method)}, kLevel,
                        run.part(0.0, 0.6));
  const GrowingScore score(measurer, run);
  const UprightFrame frame = upright_frame(up_vector(up));
  auto [best, worst] = search_under_prior(score, score.highest(), options.prior, frame,
                                          options.search, run.part(0.6, 1.0), {});
  ViewReport report;
  report.camera = scoring_camera(shape, options);
  report.up = up;
  report.total = kNone;
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, 2);
  const auto described = [&](const FoundView& found, bool is_best) {
    ReportedView view =
        describe_view(shape, *visibility, report.camera, found.direction, up, options);
    view.score = measurer.values(std::vector<Vec3>{found.direction}).front().front();
    view.score_fraction = kNone;
    view.objective = is_best ? score.score(view.score) * options.prior.factor(frame, view.direction)
                             : view.score;
    return view;
  };
  report.best = described(best, true);
  report.worst = described(worst, false);
  for (FoundView* found : {&best, &worst}) {
    for (SearchStep& step : found->trace) {
      step.score = score.is_falling() ? score.highest() - step.score : step.score;
    }
  }
  report.best_search = std::move(best);
  report.worst_search = std::move(worst);
  return report;
}

}  // namespace vantage
