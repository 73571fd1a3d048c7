// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/view/measure.h"

#include "core/parallel.h"
#include "core/unit_direction.h"
#include "view/measured_model.h"
#include "view/shared_logs.h"
#include "view/skeleton_sight.h"
#include "view/view_likelihood.h"

namespace vantage {
namespace {

constexpr std::size_t kNotOfSet = ~std::size_t{0};
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();  // never a value

MeasureNeeds both(MeasureNeeds a, const MeasureNeeds& b) {
  a.vertices |= b.vertices;
  a.faces |= b.faces;
  a.outline |= b.outline;
  a.channel |= b.channel;
  a.neighbours |= b.neighbours;
  a.kssm |= b.kssm;
  a.saliency |= b.saliency;
  a.skeleton |= b.skeleton;
  return a;
}

/// Whether a look for `wanted` tells all that is needed.
bool is_covered(const MeasureNeeds& needed, const MeasureNeeds& wanted) {
  return both(wanted, needed) == wanted;
}

MeasureNeeds needs_of_all(const std::vector<Measure>& measures) {
  MeasureNeeds needs;
  for (const Measure& measure : measures) {
    needs = both(needs, measure.needs);
  }
  return needs;
}

}  // namespace

struct ViewMeasurer::State {
  MeasuredModel model{};
  std::vector<Measure> measures{};
  MeasureNeeds needs{};
  std::optional<VertexVisibility> vertices{};  // unless `faces` answers for them too
  std::optional<FaceVisibility> faces{};
  std::optional<OutlineTracer> outlines{};
  MeasureValues of_set{};
  bool is_measured = false;     // all of of_set
  bool keeps_vertices = false;  // of views of the set
  int set_level = 0;
  ViewChannel channel{};  // unless the subject brings it; what model.set_views refers to
  std::map<std::array<double, 3>, std::vector<double>> kept{};  // of each direction and measure

  void prepare();
  void survey(const RunContext& run);
  void measure_set(const RunContext& run);
  void look_at_set(const RunContext& run);
  [[nodiscard]] bool is_of_set() const;
  [[nodiscard]] bool is_seen_by_set() const;
  void take_seen_by_set(const RunContext& run);
  void look_at_view_of_set(std::size_t i, const RunContext& run);
  [[nodiscard]] SightTable sight_of_set(std::size_t i) const;
  [[nodiscard]] std::vector<double> estimates_of_set(std::size_t m, const RunContext& run) const;
  [[nodiscard]] SightTable look(const Viewpoint& eye, const MeasureNeeds& wanted,
                                std::size_t set_index, const RunContext& run,
                                FaceDetail detail = FaceDetail::Exact) const;
  void look_at_faces(const MeasureNeeds& wanted, FaceDetail detail, const RunContext& run,
                     SightTable& sight) const;
  [[nodiscard]] std::vector<double> values_of(std::size_t m, std::span<const Vec3> directions,
                                              FaceDetail detail, const RunContext& run) const;
  [[nodiscard]] MeasureValues values_with(std::size_t m, std::span<const Vec3> directions,
                                          const RunContext& run) const;
  std::vector<double> kept_values_of(std::size_t m, std::span<const Vec3> directions,
                                     const RunContext& run);
  [[nodiscard]] MeasureNeeds needs_of(std::size_t m) const;
  [[nodiscard]] double value(std::size_t m, const SightTable& sight,
                             FaceDetail detail = FaceDetail::Exact) const;
};

bool ViewMeasurer::State::is_of_set() const {
  return needs.channel || needs.neighbours;
}

/// \pre model, measures and their needs are there.
void ViewMeasurer::State::prepare() {
  const TriMesh& mesh = *model.given.surface;
  const std::vector<FaceSides> sides(model.given.sides.begin(), model.given.sides.end());
  const bool by_area = model.given.weight == Weight::Area && (needs.kssm || needs.saliency);
  needs.faces |= is_of_set() || by_area;
  keeps_vertices = std::any_of(measures.begin(), measures.end(), [](const Measure& measure) {
    return measure.is_of_set() && measure.needs.vertices;
  });
  if (needs.faces) {
    faces.emplace(mesh, sides);
  } else if (needs.vertices) {
    vertices.emplace(mesh, sides, model.set.directions.size());
  }
  if (needs.outline) {
    outlines.emplace(mesh, sides, model.given.camera.sphere);
  }
}

/// Fills in what one look at the surface tells. \param sight has the eye.
void ViewMeasurer::State::look_at_faces(const MeasureNeeds& wanted, FaceDetail detail,
                                        const RunContext& run, SightTable& sight) const {
  SeenSurface seen = faces->seen_surface(sight.eye, run, detail);
  if (wanted.vertices) {
    sight.vertices = std::move(seen.vertices);
  }
  const double unit = faces->area_unit();
  for (const SeenFace& face : seen.faces) {
    const auto area = static_cast<float>(face.projected_area / unit);
    if (area > 0.0F && std::isfinite(area)) {
      sight.faces.push_back({face.face, area});
      sight.projected_area += area;
    }
  }
  sight.area_logs = sum_of_logs(sight.faces);
  sight.faces.shrink_to_fit();
  if (model.given.weight == Weight::Area && wanted.kssm) {
    sight.kssm_sum = faces->visible_integral(model.given.kssm, seen.faces) / faces->total_area();
  }
  if (model.given.weight == Weight::Area && wanted.saliency) {
    sight.saliency_sum = faces->visible_integral(model.saliency, seen.faces) / faces->total_area();
  }
  sight.depths = seen.depths;
  sight.deepest = seen.deepest;
}

/// With one thread, as looks are taken side by side.
SightTable ViewMeasurer::State::look(const Viewpoint& eye, const MeasureNeeds& wanted,
                                     std::size_t set_index, const RunContext& run,
                                     FaceDetail detail) const {
  const RunContext alone = run.alone();
  const SilhouetteDisc disc = silhouette_disc(model.given.camera.sphere, eye);
  SightTable sight;
  sight.eye = eye;
  sight.towards = disc.towards;
  sight.disc_area =
      0.25 * std::numbers::pi * disc.diameter * disc.diameter / (faces ? faces->area_unit() : 1.0);
  if (wanted.faces) {
    look_at_faces(wanted, detail, alone, sight);
  } else if (wanted.vertices) {
    sight.vertices =
        faces ? faces->visible_vertices(eye, alone) : vertices->visible_vertices(eye, alone);
  }
  sight.sees_vertices = std::ranges::find(sight.vertices, 1) != sight.vertices.end();
  if (wanted.skeleton) {
    sight.skeleton = skeleton_sight(model, sight);
  }
  if (wanted.channel && !model.set_views.empty()) {
    sight.channel = channel_measures(sight.faces, model.terms);
  }
  if (wanted.outline) {
    sight.outline = measure_outline(outlines->trace(eye), kTurningPhases);
  }
  if (wanted.neighbours) {
    if (set_index != kNotOfSet) {
      const auto row = model.next_views[set_index];
      sight.neighbours.assign(row.begin(), row.end());
      sight.set_index = static_cast<std::uint32_t>(set_index);
    } else {
      sight.neighbours = views_around(model.set, model.next_views, sight.towards);
    }
  }
  return sight;
}

/// \param detail of what the sight tells; unless it is exact, an estimate will do.
double ViewMeasurer::State::value(std::size_t m, const SightTable& sight, FaceDetail detail) const {
  // What else was looked at for other measures must not matter.
  const MeasureNeeds& own = measures[m].needs;
  if (own.faces ? sight.faces.empty() : own.vertices && !sight.sees_vertices) {
    return measures[m].worst();
  }
  const bool is_estimate = detail != FaceDetail::Exact && measures[m].estimate;
  const double value = (is_estimate ? measures[m].estimate : measures[m].value)(model, sight);
  if (std::isnan(value)) {
    throw InvalidInput("the measure " + measures[m].name +
                       " returned a value that is not a number");
  }
  return value;
}

MeasureNeeds ViewMeasurer::State::needs_of(std::size_t m) const {
  MeasureNeeds own = measures[m].needs;
  own.faces |= model.given.weight == Weight::Area && (own.kssm || own.saliency);
  return own;
}

std::vector<double> ViewMeasurer::State::values_of(std::size_t m, std::span<const Vec3> directions,
                                                   FaceDetail detail, const RunContext& run) const {
  const MeasureNeeds own = needs_of(m);
  std::vector<double> values(directions.size(), 0.0);
  parallel_for(run, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Viewpoint eye = model.given.camera.viewpoint(directions[i]);
      values[i] = value(m, look(eye, own, kNotOfSet, run, detail), detail);
    }
  });
  return values;
}

/// Values of one measure, and of all others that the same look tells at little cost; NaN of the rest.
MeasureValues ViewMeasurer::State::values_with(std::size_t m, std::span<const Vec3> directions,
                                               const RunContext& run) const {
  MeasureNeeds wanted = needs_of(m);
  wanted.channel |= wanted.faces && needs.channel;
  wanted.kssm |= needs.kssm;
  wanted.saliency |= needs.saliency;
  MeasureValues values(measures.size(), std::vector<double>(directions.size(), kNotMeasured));
  parallel_for(run, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Viewpoint eye = model.given.camera.viewpoint(directions[i]);
      const SightTable sight = look(eye, wanted, kNotOfSet, run);
      for (std::size_t k = 0; k < measures.size(); ++k) {
        const MeasureNeeds own = needs_of(k);
        if (k == m || (is_covered(own, wanted) && !own.neighbours)) {  // comparing views takes long
          values[k][i] = value(k, sight);
        }
      }
    }
  });
  return values;
}

std::vector<double> ViewMeasurer::State::kept_values_of(std::size_t m,
                                                        std::span<const Vec3> directions,
                                                        const RunContext& run) {
  const auto row_of = [&](const Vec3& given) -> std::vector<double>& {
    const Vec3 d = unit_direction(given);
    return kept.try_emplace({d.x(), d.y(), d.z()}, measures.size(), kNotMeasured).first->second;
  };
  std::vector<Vec3> fresh;
  for (const Vec3& direction : directions) {
    if (std::isnan(row_of(direction)[m])) {
      fresh.push_back(direction);
    }
  }
  const MeasureValues values = values_with(m, fresh, run);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    std::vector<double>& row = row_of(fresh[i]);
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k] = std::isnan(values[k][i]) ? row[k] : values[k][i];
    }
  }
  std::vector<double> of_measure(directions.size());
  std::ranges::transform(directions, of_measure.begin(),
                         [&](const Vec3& direction) { return row_of(direction)[m]; });
  return of_measure;
}

/// Looks at a view of the set, keeps what it sees, and measures what needs no other view.
void ViewMeasurer::State::look_at_view_of_set(std::size_t i, const RunContext& run) {
  SightTable sight = look(model.given.camera.viewpoint(model.set.directions[i]), needs, i, run);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    of_set[m][i] = measures[m].is_of_set() ? 0.0 : value(m, sight);
  }
  if (is_of_set()) {
    channel.views[i] = std::move(sight.faces);
    if (!keeps_vertices) {
      sight.vertices = {};
    }
    model.set_sights[i] = std::move(sight);
  }
}

/// All that a view of the set sees. \pre set_sights, set_views and terms are there.
SightTable ViewMeasurer::State::sight_of_set(std::size_t i) const {
  SightTable sight = model.set_sights[i];
  sight.faces.assign(model.set_views[i].begin(), model.set_views[i].end());
  if (needs.channel) {
    sight.channel = channel_measures(sight.faces, model.terms);
  }
  return sight;
}

/// \pre the measure is of the set and has an estimate.
std::vector<double> ViewMeasurer::State::estimates_of_set(std::size_t m,
                                                          const RunContext& run) const {
  std::vector<double> estimates(model.set.directions.size(), 0.0);
  parallel_for(run.quiet(), estimates.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      estimates[i] = value(m, sight_of_set(i), FaceDetail::ByCorners);
    }
  });
  return estimates;
}

/// Whether the subject brings all that its measures look at in views of the set.
bool ViewMeasurer::State::is_seen_by_set() const {
  const ViewChannel* seen = model.given.seen_by_set;
  return seen != nullptr && seen->face_count == model.face_areas.size() &&
         seen->views.size() == model.set.directions.size() && !needs.vertices && !needs.outline &&
         !needs.skeleton &&
         std::all_of(measures.begin(), measures.end(),
                     [](const Measure& measure) { return measure.is_of_set(); });
}

/// Looks at all views of the set once.
void ViewMeasurer::State::look_at_set(const RunContext& run) {
  const std::size_t count = model.set.directions.size();
  channel = {model.face_areas.size(), std::vector<std::vector<FaceArea>>(is_of_set() ? count : 0)};
  model.set_sights.resize(channel.views.size());
  // In a few batches, so that progress can be told and a stop be heard.
  constexpr std::size_t kBatch = 64;
  for (std::size_t start = 0; start < count; start += kBatch) {
    run.advance("views", 0.8 * static_cast<double>(start) / static_cast<double>(count));
    parallel_for(run.quiet(), std::min(kBatch, count - start), 1,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = start + begin; i < start + end; ++i) {
                     look_at_view_of_set(i, run);
                   }
                 });
  }
  model.set_views = channel.views;
}

/// Takes what the set sees from the subject, in place of looking.
void ViewMeasurer::State::take_seen_by_set(const RunContext& run) {
  model.set_views = model.given.seen_by_set->views;
  for (std::size_t i = 0; i < model.set_views.size(); ++i) {
    const Viewpoint eye = model.given.camera.viewpoint(model.set.directions[i]);
    SightTable sight = look(eye, {.neighbours = needs.neighbours}, i, run);
    for (const FaceArea& face : model.set_views[i]) {
      sight.projected_area += face.area;
    }
    sight.area_logs = sum_of_logs(model.set_views[i]);
    model.set_sights.push_back(std::move(sight));
  }
}

/// Looks at the views of the set, measures what can be measured of each alone, and takes from all of
/// them together what measures of the set need.
void ViewMeasurer::State::survey(const RunContext& run) {
  of_set.assign(measures.size(), std::vector<double>(model.set.directions.size(), 0.0));
  const bool is_seen = is_seen_by_set();
  if (is_seen) {
    take_seen_by_set(run);
  } else {
    look_at_set(run);
  }
  run.advance("views", 0.8);
  if (needs.channel) {
    model.terms = is_seen && model.given.terms_of_set != nullptr
                      ? *model.given.terms_of_set
                      : channel_terms(is_seen ? *model.given.seen_by_set : channel,
                                      *model.given.surface, run.quiet());
  }
  run.advance("views", 0.9);
  if (needs.neighbours) {
    model.divergences = neighbour_divergences(model.set_views, model.next_views, run.quiet());
  }
}

/// Measures all that is not measured yet.
void ViewMeasurer::State::measure_set(const RunContext& run) {
  if (of_set.empty()) {
    survey(run);
  }
  if (!is_measured && is_of_set()) {
    parallel_for(run.quiet(), model.set.directions.size(), 1,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     const SightTable sight = sight_of_set(i);
                     for (std::size_t m = 0; m < measures.size(); ++m) {
                       if (measures[m].is_of_set()) {
                         of_set[m][i] = value(m, sight);
                       }
                     }
                   }
                 });
  }
  is_measured = true;
}

ViewMeasurer::ViewMeasurer(const MeasureSubject& subject, std::vector<Measure> measures, int level,
                           const RunContext& run)
    : state_(std::make_unique<State>()) {
  if (subject.surface == nullptr || level < 0 || level > 6) {
    throw InvalidInput("measuring needs a surface and a set of views of level 0 to 6");
  }
  for (const Measure& measure : measures) {
    if (!measure.value) {
      throw InvalidInput("the measure " + measure.name + " has no function for its value");
    }
  }
  state_->needs = needs_of_all(measures);
  state_->measures = std::move(measures);
  state_->set_level = level;
  const double prepared = state_->needs.saliency ? 0.2 : 0.0;  // of the time
  state_->model = measured_model(subject, level, state_->needs, run.part(0.0, prepared));
  state_->prepare();
  if (state_->is_of_set()) {
    state_->survey(run.part(prepared, 1.0));
  }
}

ViewMeasurer::~ViewMeasurer() = default;
ViewMeasurer::ViewMeasurer(ViewMeasurer&&) noexcept = default;
ViewMeasurer& ViewMeasurer::operator=(ViewMeasurer&&) noexcept = default;

const std::vector<Measure>& ViewMeasurer::measures() const {
  return state_->measures;
}

const Measure& ViewMeasurer::measure(std::size_t m) const {
  const std::size_t count = state_->measures.size();
  if (m >= count) {
    throw InvalidInput("there is no measure " + std::to_string(m) + ": the measurer has " +
                       std::to_string(count) + ", counted from 0");
  }
  return state_->measures[m];
}

const MeasuredModel& ViewMeasurer::model() const {
  return state_->model;
}

int ViewMeasurer::set_level() const {
  return state_->set_level;
}

const DirectionSet& ViewMeasurer::set() const {
  return state_->model.set;
}

const MeasureValues& ViewMeasurer::set_values(const RunContext& run) {
  state_->measure_set(run);
  return state_->of_set;
}

MeasureValues ViewMeasurer::values(std::span<const Viewpoint> eyes, const RunContext& run) const {
  MeasureValues values(state_->measures.size(), std::vector<double>(eyes.size(), 0.0));
  parallel_for(run, eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SightTable sight = state_->look(eyes[i], state_->needs, kNotOfSet, run);
      for (std::size_t m = 0; m < values.size(); ++m) {
        values[m][i] = state_->value(m, sight);
      }
    }
  });
  return values;
}

MeasureValues ViewMeasurer::values(std::span<const Vec3> directions, const RunContext& run) const {
  return values(state_->model.given.camera.viewpoints(directions), run);
}

std::vector<double> ViewMeasurer::values_of(std::size_t m, std::span<const Vec3> directions,
                                            const RunContext& run) const {
  (void)measure(m);
  return state_->values_of(m, directions, FaceDetail::Exact, run);
}

std::vector<double> ViewMeasurer::kept_values_of(std::size_t m, std::span<const Vec3> directions,
                                                 const RunContext& run) {
  (void)measure(m);
  return state_->kept_values_of(m, directions, run);
}

bool ViewMeasurer::has_estimates(std::size_t m) const {
  (void)measure(m);
  const MeasureNeeds needs = state_->needs_of(m);
  return needs.faces && !needs.outline;
}

std::vector<double> ViewMeasurer::estimates_of(std::size_t m, std::span<const Vec3> directions,
                                               const RunContext& run) const {
  (void)measure(m);
  return state_->values_of(m, directions, FaceDetail::ByCorners, run);
}

SetSurvey ViewMeasurer::survey_of(std::size_t m, const RunContext& run) {
  const Measure& own = measure(m);
  if (!state_->is_measured && own.is_of_set() && own.estimate) {
    return {state_->estimates_of_set(m, run), false};
  }
  if (!state_->is_measured && !own.is_of_set() && has_estimates(m)) {
    return {estimates_of(m, set().directions, run.quiet()), false};
  }
  return {set_values(run)[m], true};
}

}  // namespace vantage
