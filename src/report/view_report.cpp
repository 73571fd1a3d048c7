// SPDX-License-Identifier: MIT
#include "vantage/report/view_report.h"

#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/render/framing.h"

#include "report/prior_search.h"
#include "report/twins.h"

namespace vantage {
namespace {

double visible_area_fraction(const TriMesh& surface, std::span<const std::uint8_t> visible) {
  const std::vector<double> areas = vertex_areas(surface);
  double seen = 0.0;
  double all = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    all += areas[v];
    seen += visible[v] != 0 ? areas[v] : 0.0;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace

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
  view.visible_area_fraction = visible_area_fraction(shape.surface, visible);
  view.picture = frame_points(referenced_points(shape.surface), camera.viewpoint(direction),
                              camera.sphere.centre, up_vector(up),
                              static_cast<double>(options.width) / options.height);
  return view;
}

ViewReport find_views(const ShapeAnalysis& shape, UpAxis up, const ViewOptions& options,
                      const RunContext& run) {
  check_fields(options, kViewFields);
  ViewReport report;
  report.camera = scoring_camera(shape, options);
  report.up = up;
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ViewScorer scorer(visibility, shape.map.of_vertex, report.camera);
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
  const UprightFrame frame = upright_frame(up_vector(up));
  auto [best, worst] =
      search_under_prior(score, report.total, options.prior, frame, options.search, run);
  report.twins = twins_of(best.direction, shape, scorer, options.prior, frame);
  if (!options.prior.is_uniform) {
    TwinView first{best.direction, best.score,
                   best.score * options.prior.factor(frame, best.direction)};
    settle_near_ties(first, report.twins, frame);
    best.direction = first.direction;
    best.score = first.score;
  }
  report.best = describe_view(shape, visibility, report.camera, best.direction, up, options);
  report.best.objective = report.best.score * options.prior.factor(frame, best.direction);
  report.worst = describe_view(shape, visibility, report.camera, worst.direction, up, options);
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
