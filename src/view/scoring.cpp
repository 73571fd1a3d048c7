// SPDX-License-Identifier: MIT
#include "vantage/view/scoring.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vantage/core/error.h"

#include "core/parallel.h"
#include "core/sizes.h"
#include "core/unit_direction.h"

namespace vantage {

double ScoringCamera::distance() const {
  const double radius = 0.5 * sphere.diameter;
  if (distance_factor.has_value()) {
    return *distance_factor * radius;
  }
  return radius / std::sin(0.5 * fov_y_deg * std::numbers::pi / 180.0);
}

Vec3 ScoringCamera::eye(const Vec3& direction) const {
  return sphere.centre + distance() * unit_direction(direction);
}

Viewpoint ScoringCamera::viewpoint(const Vec3& direction) const {
  return {projection,
          projection == Projection::Perspective ? eye(direction) : unit_direction(direction)};
}

std::vector<Viewpoint> ScoringCamera::viewpoints(std::span<const Vec3> directions) const {
  std::vector<Viewpoint> eyes;
  eyes.reserve(directions.size());
  for (const Vec3& direction : directions) {
    eyes.push_back(viewpoint(direction));
  }
  return eyes;
}

double visible_sum(std::span<const double> significance, std::span<const std::uint8_t> visible) {
  require_count(significance.size(), "values of the map", visible.size(), "vertices");
  double sum = 0.0;
  for (std::size_t v = 0; v < significance.size(); ++v) {
    sum += visible[v] != 0 ? significance[v] : 0.0;
  }
  return sum;
}

ViewScorer::ViewScorer(std::span<const double> significance, const ScoringCamera& camera)
    : significance_(significance), camera_(camera) {
  for (const double s : significance) {
    if (!(s >= 0.0) || !std::isfinite(s)) {
      throw InvalidInput("a significance map must be finite and nowhere negative");
    }
  }
  if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0)) {
    throw InvalidInput("the scoring camera's field of view must be between 0 and 180 degrees");
  }
  if (camera.distance_factor.has_value() && !(*camera.distance_factor > 1.0)) {
    throw InvalidInput("the scoring camera's distance must be more than 1 sphere radius");
  }
}

ViewScorer::ViewScorer(const VertexVisibility& visibility, std::span<const double> significance,
                       const ScoringCamera& camera)
    : ViewScorer(significance, camera) {
  visibility_ = &visibility;
  total_ = std::accumulate(significance.begin(), significance.end(), 0.0);
  const auto none = std::count(significance.begin(), significance.end(), 0.0);
  if (2 * static_cast<std::size_t>(none) > significance.size()) {
    for (const double s : significance) {
      asked_.push_back(s > 0.0 ? 1 : 0);
    }
  }
}

ViewScorer::ViewScorer(const FaceVisibility& faces, std::span<const double> significance,
                       const ScoringCamera& camera)
    : ViewScorer(significance, camera) {
  faces_ = &faces;
  of_face_ = faces.integrals(significance);
  const double area = faces.total_area();
  for (double& share : of_face_) {
    share = area > 0.0 ? share / area : 0.0;
  }
  total_ = std::accumulate(of_face_.begin(), of_face_.end(), 0.0);
}

double ViewScorer::score_from(const Viewpoint& eye, const RunContext& run) const {
  if (faces_ == nullptr) {
    return visible_sum(significance_, asked_.empty()
                                          ? visibility_->visible_vertices(eye, run)
                                          : visibility_->visible_among(asked_, eye, run));
  }
  const double area = faces_->total_area();
  const double sum = faces_->visible_integral(significance_, faces_->seen_faces(eye, run));
  return area > 0.0 ? sum / area : 0.0;
}

double ViewScorer::score(const Vec3& direction, const RunContext& run) const {
  return score_from(camera_.viewpoint(direction), run);
}

std::vector<double> ViewScorer::score_all(std::span<const Vec3> directions,
                                          const RunContext& run) const {
  std::vector<double> scores(directions.size(), 0.0);
  parallel_items(run, directions.size(), [&](std::size_t i, const RunContext& own) {
    scores[i] = score_from(camera_.viewpoint(directions[i]), own);
  });
  return scores;
}

}  // namespace vantage
