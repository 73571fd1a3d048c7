// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"

#include "spatial/ray_scene.h"

namespace vantage {

/// A level floor: points p with p · up = height; it blocks what goes below.
struct Floor {
  Vec3 up = Vec3::UnitY();  ///< Unit.
  double height = 0.0;
};

/// Axes of a hemisphere; unit vectors at right angles.
struct HemisphereFrame {
  Vec3f normal = Vec3f::UnitZ();
  Vec3f tangent = Vec3f::UnitX();
  Vec3f bitangent = Vec3f::UnitY();
};

/// The frame that turning `axis` the shortest way to `normal` makes of `axis`, `right` and `up`: it
/// has no seam among normals that are not opposite to `axis`.
/// \param right and \param up unit vectors that make a frame with `axis`.
HemisphereFrame turned_frame(const Vec3f& normal, const Vec3f& axis, const Vec3f& right,
                             const Vec3f& up);

/// Directions of a hemisphere, denser towards its pole by the cosine: a Hammersley set, dealt out
/// to `parts` neighbours that together have all of it.
class HemisphereDirections {
 public:
  /// \param each directions of a part.
  HemisphereDirections(std::size_t each, std::size_t parts);

  /// In a frame whose z is the pole.
  [[nodiscard]] std::span<const Vec3f> part(std::size_t index) const {
    return std::span(directions_).subspan(index * each_, each_);
  }

 private:
  std::size_t each_;
  std::vector<Vec3f> directions_{};
};

/// How much of the sky a point sees.
class Occlusion {
 public:
  /// \param scene must outlive this. \param reach how far away things still block.
  /// \param offset how far off the surface rays start. \param width of the rays.
  Occlusion(const RayScene& scene, double reach, double offset, const std::optional<Floor>& floor,
            double width = 0.0);

  /// Unblocked part of the hemisphere, in [0, 1], by those directions of it.
  /// \param face_normal of the flat face under the point, unit; directions below the face are
  /// mirrored above it, lest it blocks itself.
  [[nodiscard]] float openness(const Vec3f& position, const HemisphereFrame& frame,
                               const Vec3f& face_normal, std::span<const Vec3f> directions) const;

 private:
  [[nodiscard]] bool below_floor(const Vec3f& origin, const Vec3f& direction) const;

  const RayScene* scene_;
  float reach_;
  float offset_;
  std::optional<Floor> floor_;
  float width_;
};

}  // namespace vantage
