// SPDX-License-Identifier: MIT
#include "pipeline/survey_sight.h"

#include <array>

#include "vantage/spatial/directions.h"

#include "core/parallel.h"

namespace vantage {
namespace {

constexpr int kLevel = 4;  // ViewObjective::survey_level

std::array<double, 3> key_of(const Vec3& direction) {
  return {direction.x(), direction.y(), direction.z()};
}

}  // namespace

SurveySight::SurveySight(const VertexVisibility& visibility, const ScoringCamera& camera,
                         const RunContext& run)
    : camera_(camera) {
  const std::vector<Vec3> directions =
      direction_set(ViewSphereBase::Icosahedron, kLevel).directions;
  visible_.resize(directions.size());
  const RunContext quiet{.stop = run.stop, .max_threads = run.max_threads};
  parallel_items(quiet, directions.size(), [&](std::size_t i, const RunContext& own) {
    visible_[i] = visibility.visible_vertices(camera.viewpoint(directions[i]), own);
  });
  for (std::size_t i = 0; i < directions.size(); ++i) {
    index_[key_of(directions[i])] = i;
  }
}

bool SurveySight::is_of(const ScoringCamera& camera) const {
  return camera.sphere.centre == camera_.sphere.centre &&
         camera.sphere.diameter == camera_.sphere.diameter &&
         camera.projection == camera_.projection && camera.fov_y_deg == camera_.fov_y_deg &&
         camera.distance_factor == camera_.distance_factor;
}

std::optional<double> SurveySight::score(const Vec3& direction,
                                         std::span<const double> shares) const {
  const auto found = index_.find(key_of(direction));
  if (found == index_.end()) {
    return std::nullopt;
  }
  return visible_sum(shares, visible_[found->second]);
}

}  // namespace vantage
