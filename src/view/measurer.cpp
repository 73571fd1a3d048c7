// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/significance/mesh_saliency.h"
#include "vantage/view/measure.h"

#include "core/parallel.h"
#include "core/shannon.h"
#include "mesh/curvature.h"
#include "view/shared_logs.h"
#include "view/skeleton_sight.h"
#include "view/view_likelihood.h"

namespace vantage {
namespace {

constexpr std::size_t kNotOfSet = ~std::size_t{0};

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

/// Second moment of the surface about its centroid over its area, in closed form.
Eigen::Matrix3d spread_of(const TriMesh& mesh, const std::vector<double>& areas, double total) {
  Vec3 centre = Vec3::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      centre += areas[f] / 3.0 * (mesh.positions[v] - mesh.positions[0]);
    }
  }
  centre = mesh.positions[0] + centre / total;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f) {
    // ∫ x xᵀ over a triangle: area / 12 times (Σ of the corners' own products + that of their sum).
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t v : mesh.triangles[f]) {
      const Vec3 p = mesh.positions[v] - centre;
      moment += areas[f] / 12.0 * p * p.transpose();
      sum += p;
    }
    moment += areas[f] / 12.0 * sum * sum.transpose();
  }
  return moment / total;
}

/// Whether all that a measure looks at is among what is kept of the set's views.
bool is_kept(const MeasureNeeds& needs) {
  return !needs.vertices && !needs.outline;
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
  bool is_measured = false;  // all of of_set
  int set_level = 0;
  ViewChannel channel{};  // unless the subject brings it; what model.set_views refers to

  void prepare(const RunContext& run);
  void prepare_maps(const RunContext& run);
  void survey(const RunContext& run);
  void measure_set(const RunContext& run);
  void look_at_set(const RunContext& run);
  [[nodiscard]] bool is_seen_by_set() const;
  void take(const ViewChannel& seen, const RunContext& run);
  std::vector<FaceArea> measure_early(std::size_t i);
  [[nodiscard]] SightTable kept_sight(std::size_t i) const;
  void measure_late(std::size_t i);
  [[nodiscard]] std::vector<double> estimates_of_set(std::size_t m, const RunContext& run) const;
  [[nodiscard]] SightTable look(const Viewpoint& eye, const MeasureNeeds& wanted,
                                std::size_t set_index, FaceDetail detail = FaceDetail::Exact) const;
  void look_at_faces(const MeasureNeeds& wanted, FaceDetail detail, SightTable& sight) const;
  [[nodiscard]] std::vector<double> values_of(std::size_t m, std::span<const Vec3> directions,
                                              FaceDetail detail, const RunContext& run) const;
  [[nodiscard]] MeasureNeeds needs_of(std::size_t m) const;
  [[nodiscard]] double value(std::size_t m, const SightTable& sight,
                             FaceDetail detail = FaceDetail::Exact) const;
};

void ViewMeasurer::State::prepare(const RunContext& run) {
  const TriMesh& mesh = *model.given.surface;
  model.face_areas = face_areas(mesh);
  model.log_face_areas.reserve(model.face_areas.size());
  for (const double area : model.face_areas) {
    model.surface_area += area;
    model.log_face_areas.push_back(area > 0.0 ? log_2(area) : 0.0);
  }
  if (!(model.surface_area > 0.0) || !(model.given.camera.sphere.diameter > 0.0)) {
    throw InvalidInput("a surface without area cannot be measured");
  }
  if ((needs.kssm && model.given.kssm.size() != mesh.positions.size()) ||
      (needs.skeleton && (model.given.skeleton == nullptr ||
                          model.given.node_of_vertex.size() != mesh.positions.size()))) {
    throw InvalidInput("a measure needs a map or a skeleton that the model was not given");
  }
  const bool by_area = model.given.weight == Weight::Area && (needs.kssm || needs.saliency);
  const std::vector<FaceSides> sides(model.given.sides.begin(), model.given.sides.end());
  needs.faces |= needs.channel || needs.neighbours || by_area;
  if (needs.faces) {
    faces.emplace(mesh, sides);
  }
  if (needs.skeleton) {
    const Vec3& centre = model.given.camera.sphere.centre;
    model.areas_at_vertex.assign(mesh.positions.size(), 0.0);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& face = mesh.triangles[f];
      const Vec3 normal = area_vector(mesh, face);
      model.planes.push_back({normal, normal.dot(mesh.positions[face[0]] - centre)});
      for (const std::uint32_t v : face) {
        model.areas_at_vertex[v] += model.face_areas[f];
      }
    }
  }
  if (needs.vertices) {
    if (!faces) {
      vertices.emplace(mesh, sides);
    }
    model.angle_deficits = angle_deficits(mesh);
  }
  if (needs.outline) {
    outlines.emplace(mesh, sides, model.given.camera.sphere);
  }
  model.spread = spread_of(mesh, model.face_areas, model.surface_area);
  if (needs.neighbours) {
    model.next_views = vertex_neighbours({model.set.directions, model.set.triangles});
    model.next_coarse_views =
        vertex_neighbours({model.coarse_set.directions, model.coarse_set.triangles});
  }
  prepare_maps(run);
}

void ViewMeasurer::State::prepare_maps(const RunContext& run) {
  const TriMesh& mesh = *model.given.surface;
  if (needs.saliency) {
    model.saliency.assign(model.given.saliency.begin(), model.given.saliency.end());
    if (model.saliency.size() != mesh.positions.size()) {
      model.saliency = compute_mesh_saliency(mesh, {}, run.quiet()).of_vertex;
    }
  }
}

/// Fills in what one look at the surface tells. \param sight has the eye.
void ViewMeasurer::State::look_at_faces(const MeasureNeeds& wanted, FaceDetail detail,
                                        SightTable& sight) const {
  const RunContext alone{.max_threads = 1};
  SeenSurface seen = faces->seen_surface(sight.eye, alone, detail);
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

SightTable ViewMeasurer::State::look(const Viewpoint& eye, const MeasureNeeds& wanted,
                                     std::size_t set_index, FaceDetail detail) const {
  const RunContext alone{.max_threads = 1};
  const SilhouetteDisc disc = silhouette_disc(model.given.camera.sphere, eye);
  SightTable sight;
  sight.eye = eye;
  sight.towards = disc.towards;
  sight.disc_area =
      0.25 * std::numbers::pi * disc.diameter * disc.diameter / (faces ? faces->area_unit() : 1.0);
  if (wanted.faces) {
    look_at_faces(wanted, detail, sight);
  } else if (wanted.vertices) {
    sight.vertices =
        faces ? faces->visible_vertices(eye, alone) : vertices->visible_vertices(eye, alone);
  }
  sight.sees_vertices =
      std::find(sight.vertices.begin(), sight.vertices.end(), 1) != sight.vertices.end();
  if (wanted.skeleton) {
    sight.skeleton = skeleton_sight(model, sight);
  }
  if (wanted.channel && !model.set_views.empty()) {
    sight.channel = channel_measures(sight.faces, model.terms, model.face_areas);
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
  return std::isnan(value) ? measures[m].worst() : value;
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
      values[i] = value(m, look(eye, own, kNotOfSet, detail), detail);
    }
  });
  return values;
}

/// First pass over a view of the set. \return the faces it sees.
std::vector<FaceArea> ViewMeasurer::State::measure_early(std::size_t i) {
  SightTable sight = look(model.given.camera.viewpoint(model.set.directions[i]), needs, i);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    of_set[m][i] = measures[m].is_of_set() ? 0.0 : value(m, sight);
  }
  return std::move(sight.faces);
}

/// What is kept of a view of the set. \pre terms and set_views are there.
SightTable ViewMeasurer::State::kept_sight(std::size_t i) const {
  const Viewpoint eye = model.given.camera.viewpoint(model.set.directions[i]);
  SightTable sight = look(eye, {.neighbours = needs.neighbours}, i);
  sight.faces.assign(model.set_views[i].begin(), model.set_views[i].end());
  sight.projected_area = model.set_sums[i][0];
  sight.area_logs = model.set_sums[i][1];
  if (needs.channel) {
    sight.channel = channel_measures(sight.faces, model.terms, model.face_areas);
  }
  return sight;
}

/// Values of a view of the set that need all the others.
void ViewMeasurer::State::measure_late(std::size_t i) {
  const SightTable sight = kept_sight(i);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (measures[m].is_of_set()) {
      of_set[m][i] = value(m, is_kept(measures[m].needs) ? sight : look(sight.eye, needs, i));
    }
  }
}

/// \pre the measure is of the set, has an estimate and looks at no more than is kept.
std::vector<double> ViewMeasurer::State::estimates_of_set(std::size_t m,
                                                          const RunContext& run) const {
  std::vector<double> estimates(model.set.directions.size(), 0.0);
  parallel_for(run.quiet(), estimates.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      estimates[i] = value(m, kept_sight(i), FaceDetail::ByCorners);
    }
  });
  return estimates;
}

/// Whether the subject brings all that its measures look at in views of the set.
bool ViewMeasurer::State::is_seen_by_set() const {
  const ViewChannel* seen = model.given.seen_by_set;
  return seen != nullptr && seen->face_count == model.face_areas.size() &&
         seen->views.size() == model.set.directions.size() && is_kept(needs) &&
         std::all_of(measures.begin(), measures.end(),
                     [](const Measure& measure) { return measure.is_of_set(); });
}

/// Looks at all views of the set once.
void ViewMeasurer::State::look_at_set(const RunContext& run) {
  const std::size_t count = model.set.directions.size();
  const bool keeps_faces = needs.channel || needs.neighbours;
  channel = {model.face_areas.size(), std::vector<std::vector<FaceArea>>(keeps_faces ? count : 0)};
  // In a few batches, so that progress can be told and a stop be heard.
  constexpr std::size_t kBatch = 64;
  for (std::size_t start = 0; start < count; start += kBatch) {
    run.advance("views", 0.8 * static_cast<double>(start) / static_cast<double>(count));
    parallel_for(run.quiet(), std::min(kBatch, count - start), 1,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = start + begin; i < start + end; ++i) {
                     std::vector<FaceArea> faces_seen = measure_early(i);
                     if (keeps_faces) {
                       channel.views[i] = std::move(faces_seen);
                     }
                   }
                 });
  }
}

/// Takes from what the set sees all that measures need of it.
void ViewMeasurer::State::take(const ViewChannel& seen, const RunContext& run) {
  model.set_views = seen.views;
  model.set_sums.reserve(seen.views.size());
  for (const std::vector<FaceArea>& view : seen.views) {
    double area = 0.0;
    for (const FaceArea& face : view) {
      area += face.area;
    }
    model.set_sums.push_back({area, sum_of_logs(view)});
  }
  run.advance("views", 0.8);
  if (needs.channel) {
    model.terms = channel_terms(seen, *model.given.surface, run.quiet());
  }
  run.advance("views", 0.9);
  if (needs.neighbours) {
    model.divergences = neighbour_divergences(model.set_views, model.next_views, run.quiet());
  }
}

/// Looks at the views of the set and measures what can be measured of each alone.
void ViewMeasurer::State::survey(const RunContext& run) {
  of_set.assign(measures.size(), std::vector<double>(model.set.directions.size(), 0.0));
  const bool is_seen = is_seen_by_set();
  if (!is_seen) {
    look_at_set(run);
  }
  if (needs.channel || needs.neighbours) {
    take(is_seen ? *model.given.seen_by_set : channel, run);
  }
}

/// Measures all that is not measured yet.
void ViewMeasurer::State::measure_set(const RunContext& run) {
  if (of_set.empty()) {
    survey(run);
  }
  if (!is_measured && (needs.channel || needs.neighbours)) {
    parallel_for(run.quiet(), model.set.directions.size(), 1,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     measure_late(i);
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
  state_->model.given = subject;
  state_->set_level = level;
  state_->model.set = direction_set(ViewSphereBase::Icosahedron, level);
  state_->model.coarse_set = direction_set(ViewSphereBase::Icosahedron, std::max(0, level - 1));
  state_->measures = std::move(measures);
  for (const Measure& measure : state_->measures) {
    state_->needs = both(state_->needs, measure.needs);
  }
  state_->prepare(run);
  if (state_->needs.channel || state_->needs.neighbours) {
    state_->survey(run);
  }
}

ViewMeasurer::~ViewMeasurer() = default;
ViewMeasurer::ViewMeasurer(ViewMeasurer&&) noexcept = default;
ViewMeasurer& ViewMeasurer::operator=(ViewMeasurer&&) noexcept = default;

const std::vector<Measure>& ViewMeasurer::measures() const {
  return state_->measures;
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
      const SightTable sight = state_->look(eyes[i], state_->needs, kNotOfSet);
      for (std::size_t m = 0; m < values.size(); ++m) {
        values[m][i] = state_->value(m, sight);
      }
    }
  });
  return values;
}

MeasureValues ViewMeasurer::values(std::span<const Vec3> directions, const RunContext& run) const {
  std::vector<Viewpoint> eyes;
  eyes.reserve(directions.size());
  for (const Vec3& direction : directions) {
    eyes.push_back(state_->model.given.camera.viewpoint(direction));
  }
  return values(eyes, run);
}

std::vector<double> ViewMeasurer::values_of(std::size_t m, std::span<const Vec3> directions,
                                            const RunContext& run) const {
  return state_->values_of(m, directions, FaceDetail::Exact, run);
}

bool ViewMeasurer::has_estimates(std::size_t m) const {
  const MeasureNeeds needs = state_->needs_of(m);
  return needs.faces && !needs.outline;
}

std::vector<double> ViewMeasurer::estimates_of(std::size_t m, std::span<const Vec3> directions,
                                               const RunContext& run) const {
  return state_->values_of(m, directions, FaceDetail::ByCorners, run);
}

SetSurvey ViewMeasurer::survey_of(std::size_t m, const RunContext& run) {
  const Measure& measure = state_->measures[m];
  if (!state_->is_measured && measure.is_of_set() && measure.estimate) {
    return {state_->estimates_of_set(m, run), false};
  }
  if (!state_->is_measured && !measure.is_of_set() && has_estimates(m)) {
    return {estimates_of(m, set().directions, run.quiet()), false};
  }
  return {set_values(run)[m], true};
}

}  // namespace vantage
