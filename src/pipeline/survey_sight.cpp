// SPDX-License-Identifier: MIT
#include "pipeline/survey_sight.h"

#include <array>

#include "vantage/spatial/directions.h"

#include "core/parallel.h"

namespace vantage {
namespace {

std::array<double, 3> key_of(const Vec3& direction) {
  return {direction.x(), direction.y(), direction.z()};
}

}  // namespace

bool is_same(const ScoringCamera& a, const ScoringCamera& b) {
  return a.sphere.centre == b.sphere.centre && a.sphere.diameter == b.sphere.diameter &&
         a.projection == b.projection && a.fov_y_deg == b.fov_y_deg &&
         a.distance_factor == b.distance_factor;
}

SurveySight::SurveySight(const VertexVisibility& visibility, const ScoringCamera& camera, int level,
                         const RunContext& run)
    : camera_(camera) {
  const std::vector<Vec3> directions = direction_set(ViewSphereBase::Icosahedron, level).directions;
  visible_.resize(directions.size());
  const RunContext quiet = run.quiet();
  parallel_items(quiet, directions.size(), [&](std::size_t i, const RunContext& own) {
    visible_[i] = visibility.visible_vertices(camera.viewpoint(directions[i]), own);
  });
  for (std::size_t i = 0; i < directions.size(); ++i) {
    index_[key_of(directions[i])] = i;
  }
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
