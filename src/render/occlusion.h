// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "vantage/core/vec3.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// Some rays of a Hammersley set: `count` of its `total` members, every `stride`-th from `first` on.
struct HemisphereRays {
  std::size_t first = 0;
  std::size_t stride = 1;
  std::size_t count = 1;
  std::size_t total = 1;
  std::array<double, 2> shift{};  ///< Added to all members, modulo 1.
};

/// A level floor: points p with p · up = height; it blocks what goes below.
struct Floor {
  Vec3 up = Vec3::UnitY();  ///< Unit.
  double height = 0.0;
};

/// How much of the sky a point sees.
class Occlusion {
 public:
  /// \param scene must outlive this. \param reach how far away things still block.
  /// \param offset how far off the surface rays start.
  Occlusion(const RayScene& scene, double reach, double offset, const std::optional<Floor>& floor);

  /// Unblocked part of the cosine-weighted hemisphere around `normal`, in [0, 1], from that many
  /// rays. \param face_normal of the flat face under the point, unit; directions below the face are
  /// mirrored above it, lest it blocks itself.
  [[nodiscard]] double openness(const Vec3& position, const Vec3& normal, const Vec3& face_normal,
                                const HemisphereRays& rays) const;

 private:
  [[nodiscard]] bool blocked(const Vec3& origin, const Vec3& direction) const;

  const RayScene* scene_;
  double reach_;
  double offset_;
  std::optional<Floor> floor_;
};

}  // namespace vantage
