// SPDX-License-Identifier: MIT
#include "pipeline/describe_view.h"

#include <span>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"

#include "core/unit_direction.h"
#include "pipeline/view_preparation.h"

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

void frame_view(ReportedView& view, const ShapeAnalysis& shape, UpAxis up,
                const ViewOptions& options) {
  const PictureFrame frame = frame_picture(shape, view.direction, up, options);
  view.picture = frame.camera;
  view.size = frame.size;
}

ScoringCamera scoring_camera(const ShapeAnalysis& shape, const ViewOptions& options) {
  return {.sphere = shape.sphere,
          .projection = options.projection,
          .fov_y_deg = options.fov_y_deg,
          .distance_factor = options.distance_factor};
}

ReportedView describe_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                           const ScoringCamera& camera, const Vec3& direction, UpAxis up,
                           const ViewOptions& options, const RunContext& run) {
  const Vec3 to_eye = unit_direction(direction);
  const auto visible = visibility.visible_vertices(camera.viewpoint(to_eye), run.quiet());
  double total = 0.0;
  for (const double value : shape.significance) {
    total += value;
  }
  ReportedView view;
  view.direction = to_eye;
  view.eye = camera.eye(to_eye);
  view.up = upright(to_eye, up_vector(up));
  if (!shape.significance.empty()) {  // which measures of other things do without
    view.score = visible_sum(shape.significance, visible);
  }
  view.score_fraction = score_fraction(view.score, total);
  view.objective = view.score;
  view.visible_area_fraction = visible_area_fraction(
      shape.views ? shape.views->vertex_areas : vertex_areas(shape.surface), visible);
  frame_view(view, shape, up, options);
  return view;
}

ReportedView describe_scored_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                                  const ViewScorer& scorer, const Vec3& direction,
                                  const ModelFrame& frame, const ViewOptions& options,
                                  const RunContext& run) {
  ReportedView view =
      describe_view(shape, visibility, scorer.camera(), direction, frame.up, options, run);
  if (options.weight == Weight::Area) {
    view.score = scorer.score(direction, run);
    view.score_fraction = score_fraction(view.score, scorer.total());
  }
  view.objective = view.score;
  return view;
}

double score_fraction(double score, double total) {
  return total == 0.0 ? 0.0 : score / total;
}

void compare_with_highest(ViewReport& report, const Vec3& direction, double score, Better better) {
  const double own = report.best.score;
  const bool is_better = better == Better::More ? score > own : score < own;
  report.highest_direction = is_better ? direction : report.best.direction;
  report.highest_score = is_better ? score : own;
  const double most = better == Better::More ? report.highest_score : own;
  const double least = better == Better::More ? own : report.highest_score;
  if (most > 0.0 && least >= 0.0) {
    report.score_of_attainable = least / most;
  } else if (better == Better::Less && most == least) {
    report.score_of_attainable = 1.0;  // 0 as it can be
  }
}

}  // namespace vantage
