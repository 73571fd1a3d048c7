// SPDX-License-Identifier: MIT
#include "vantage/pipeline/find_views.h"

#include <algorithm>
#include <string>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/render/render.h"
#include "vantage/spatial/mirror_symmetry.h"

#include "core/parallel.h"
#include "core/unit_direction.h"
#include "pipeline/coarse_surface.h"
#include "pipeline/describe_view.h"
#include "pipeline/frame_choice.h"
#include "pipeline/map_objective.h"
#include "pipeline/percent.h"
#include "pipeline/preference.h"
#include "pipeline/required_steps.h"
#include "pipeline/scene_notes.h"
#include "pipeline/self_check.h"
#include "pipeline/settled_search.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

/// find_views() by a map that is summed.
ViewReport find_views_by_map(const ShapeAnalysis& shape, const FrameChoice& choice,
                             const ViewOptions& options, const RunContext& run) {
  ViewReport report;
  report.camera = scoring_camera(shape, options);
  report.up = choice.frame.up;
  report.front = choice.frame.front;
  const MapObjective map(shape, shape.significance, options, run);
  const ViewScorer& scorer = map.scorer();
  report.total = scorer.total();
  const Preference preference(shape, choice, options, report.total);
  const ViewObjective objective = map.objective(preference);
  const double share = !options.view_set ? 1.0 : options.certify ? 0.6 : 0.25;  // of the bar
  SettledViews settled =
      search_settled(objective, preference, shape, choice.frame, options, run.part(0.0, share));
  auto& [best, worst, highest] = settled.found;
  report.twins = std::move(settled.twins);
  report.dense_gap = settled.dense_gap;
  const auto described = [&](const FoundView& view) {
    return describe_scored_view(shape, map.visibility(), scorer, view.direction, choice.frame,
                                options, run);
  };
  report.best = described(best);
  report.best.objective = preference(best.direction, report.best.score);
  report.worst = described(worst);
  compare_with_highest(report, highest.direction, highest.score, Better::More);
  if (options.view_set) {
    report.set = find_view_set(shape, map.visibility(), scorer, best.direction, choice.frame,
                               options, report.warnings, run.part(share, 1.0));
    for (ReportedView& view : report.set->views) {
      view.objective = preference(view.direction, view.score);
    }
  }
  report.best_search = std::move(best);
  report.worst_search = std::move(worst);
  return report;
}

/// Warns of a rapid search that ends at once: what a ring gains is seldom a hundredth of the total.
void warn_of_coarse_epsilon(const SearchOptions& search, ViewReport& report) {
  constexpr double kCoarse = 0.01;
  const double share = search.epsilon / report.total;
  if (search.strategy == SearchStrategy::Rapid && !search.epsilon_is_fraction && share > kCoarse) {
    report.warnings.push_back("the rapid search ends where a ring gains less than epsilon, here " +
                              percent(std::min(share, 1e4)) +
                              " of the total: give a smaller one, or a share as 0.1%");
  }
}

/// The notes on the frame, where one on the front speaks of the best view, too.
std::vector<std::string> frame_notes(const FrameChoice& choice, const ViewOptions& options,
                                     const ReportedView& best) {
  std::vector<std::string> notes = choice.notes;
  const std::string before = note_on_front(choice, options);
  const bool is_found = objective_of(options) == Objective::People && !options.best_view;
  const std::string note = is_found ? note_on_front(choice, options, best.direction) : before;
  if (note != before) {
    std::erase(notes, before);
    notes.push_back(note);
  }
  return notes;
}

/// Says so where what tells most is hidden from everywhere.
void note_what_none_sees(ViewReport& report) {
  constexpr double kHidden =
      0.2;  // of 110 models one shows less than 0.32: spheres in a box [ours]
  if (report.highest_score > 0.0 && report.highest_score < kHidden * report.total) {
    report.warnings.push_back("no view shows more than " +
                              percent(report.highest_score / report.total) +
                              " of the significance: the rest is inside, behind other parts");
  }
}

/// The best or the worst view by a map, as a search finds it.
FoundView one_view(const MapObjective& map, const Preference& preference, Goal goal,
                   const ShapeAnalysis& shape, const ModelFrame& frame, const ViewOptions& options,
                   const RunContext& run) {
  FoundView found;
  if (goal == Goal::Best && options.best_view) {
    found.direction = unit_direction(*options.best_view);
    return found;
  }
  const ViewObjective objective = map.objective(preference);
  found = search_view(objective, goal, options.search, run);
  if (goal == Goal::Best && !preference.is_score()) {
    settle_on_the_front(found, {}, objective, preference, shape, frame);
  }
  return found;
}

/// Whether the best view, or a mirror image of it, is the best by the map of the moved copy, too.
bool is_best_of_moved(const ShapeAnalysis& shape, const FrameChoice& choice,
                      const ViewOptions& options, const MovedMap& moved, const ViewReport& report,
                      const RunContext& run) {
  constexpr double kSameRad = 0.02;  // mirror images nearer to each other are one [ours]
  constexpr double kAlike = 0.985;   // cosine of 10°: views nearer to each other look alike [ours]
  const RunContext quiet = run.quiet();
  const MapObjective map(shape, moved.significance, options, quiet);
  const Preference preference(shape, choice, options, map.scorer().total());
  const Vec3 again =
      one_view(map, preference, Goal::Best, shape, choice.frame, options, quiet).direction;
  const std::vector<Vec3> images = mirror_images(report.best.direction, planes_of(shape), kSameRad);
  return std::any_of(images.begin(), images.end(),
                     [&](const Vec3& image) { return again.dot(image) > kAlike; });
}

}  // namespace

ViewReport find_views(const ShapeAnalysis& shape, const FrameChoice& choice,
                      const ViewOptions& options, const RunContext& run) {
  check_fields(options, kViewFields);
  if (sums_a_map(options.method)) {
    require_map(shape);
  }
  ViewReport report;
  MovedMap moved;
  run_both(
      run,
      [&] {
        report = sums_a_map(options.method) ? find_views_by_map(shape, choice, options, run)
                                            : find_views_by_measure(shape, choice, options, run);
      },
      [&] { moved = checked_moved_map(shape, options, run.quiet()); });
  report.orientation = choice.orientation;
  if (options.best_view) {
    report.warnings.emplace_back("the best view is the one that the sidecar names, not one found");
  }
  warn_of_coarse_epsilon(options.search, report);
  report.proportions = proportions_of(shape.surface, shape.sphere.diameter / 2.0, planes_of(shape),
                                      upright_frame(choice.frame));
  if (sums_a_map(options.method)) {
    note_what_none_sees(report);
    note_parts_hardly_shown(shape, options, report.warnings, run);
  }
  if (moved.is_unlike() && is_best_of_moved(shape, choice, options, moved, report, run)) {
    report.warnings.push_back(unlike_map_text(moved) +
                              "; the best view is the same there, the worst may be another");
    moved = {};
  }
  note_a_skeleton_outside(shape, report.warnings);
  note_cycles_beyond_genus(shape, report.warnings);
  // Last is what a flag may set right.
  const std::vector<std::string> notes = frame_notes(choice, options, report.best);
  report.warnings.insert(report.warnings.end(), notes.begin(), notes.end());
  report.reliability_warnings = reliability_warnings(shape, report, options, moved, run);
  return report;
}

ViewReport find_views(const ShapeAnalysis& shape, const ModelFrame& frame,
                      const ViewOptions& options, const RunContext& run) {
  FrameChoice given{.frame = frame};
  given.orientation.up.direction = up_vector(frame.up);
  given.orientation.front.direction = up_vector(frame.front);
  return find_views(shape, given, options, run);
}

std::string blank_view_warning(const ShapeAnalysis& shape, const ReportedView& best,
                               const ViewOptions& options) {
  const bool counts = std::any_of(shape.significance.begin(), shape.significance.end(),
                                  [](double value) { return value > 0.0; });
  if (!sums_a_map(options.method) || !counts || best.score > 0.0) {
    return {};
  }
  const std::string text =
      "nothing significant is seen from the best view, as other parts hide it: take them out";
  return options.focus.empty() ? text : text + ", or choose another --focus";
}

ReportedView find_view(const ShapeAnalysis& shape, Goal goal, const FrameChoice& choice,
                       const ViewOptions& options, const RunContext& run) {
  check_fields(options, kViewFields);
  if (!sums_a_map(options.method)) {
    throw InvalidInput("one view alone is looked for by a map that is summed; " + options.method +
                       " sums none: best_view() finds its best");
  }
  require_map(shape);
  const MapObjective map(shape, shape.significance, options, run);
  const Preference preference(shape, choice, options, map.scorer().total());
  const FoundView found = one_view(map, preference, goal, shape, choice.frame, options, run);
  ReportedView view = describe_scored_view(shape, map.visibility(), map.scorer(), found.direction,
                                           choice.frame, options, run);
  view.objective = goal == Goal::Best ? preference(view.direction, view.score) : view.score;
  return view;
}

PictureView find_picture_view(const Model& model, const ShapeAnalysis& prepared,
                              const ViewOptions& options, const RunContext& run) {
  constexpr std::size_t kLarge = 200'000;  // vertices [ours]
  require_view(prepared, model.name);
  if (options.best_view) {
    PictureView given{.choice = choose_frame(model, prepared, options),
                      .vertices = prepared.surface.positions.size()};
    given.view.direction = unit_direction(*options.best_view);
    frame_view(given.view, prepared, given.choice.frame.up, options);
    return given;
  }
  const bool is_large = !prepared.cloud && prepared.surface.positions.size() > kLarge;
  ShapeAnalysis surface;
  if (is_large) {
    surface.check = prepared.check;
    surface.flow = prepared.flow;
    surface.sphere = prepared.sphere;
    CoarseSurface coarse =
        coarse_surface(prepared.surface, prepared.sides, kLarge / 2, run.part(0.0, 0.3));
    surface.surface = std::move(coarse.mesh);
    surface.sides = std::move(coarse.sides);
  } else {
    surface = prepared;
  }
  const ShapeAnalysis shape = analyse_surface(std::move(surface), options, run.part(0.3, 0.8),
                                              nullptr, AnalysisUse::Picture);
  PictureView found;
  // By the surface as it is: all commands answer alike.
  found.choice = choose_frame(model, is_large ? prepared : shape, options);
  found.view = find_view(shape, Goal::Best, found.choice, options, run.part(0.8, 1.0));
  found.vertices = shape.surface.positions.size();
  found.warning = blank_view_warning(shape, found.view, options);
  if (is_large) {
    frame_view(found.view, prepared, found.choice.frame.up, options);
  }
  return found;
}

}  // namespace vantage
