// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include <Eigen/Core>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// The only door to the ray tracing library (Embree 3): no other file of the project includes it.
/// Everything here is immutable after construction and may be queried from many threads at once.

namespace vantage {

using Vec3f = Eigen::Vector3f;  ///< Point or direction in single precision.

/// A similarity that brings a model to the origin and its longest side to [1, 2), where
/// single precision is at its best. The factor is a power of two, so scaling itself never rounds.
struct UnitFrame {
  Vec3 centre = Vec3::Zero();  ///< In model units; becomes the origin.
  double scale = 1.0;          ///< Power of two; > 0.

  [[nodiscard]] Vec3 to_frame(const Vec3& p) const { return (p - centre) * scale; }

  [[nodiscard]] std::vector<Vec3> to_frame(std::vector<Vec3> points) const {
    for (Vec3& p : points) {
      p = to_frame(p);
    }
    return points;
  }
};

/// The frame of the points' bounding box; the identity for no points or a single one.
UnitFrame unit_frame(std::span<const Vec3> points);

/// Where a ray meets a triangle.
struct RayHit {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t face = kNone;  ///< Index of the triangle, kNone if nothing was hit.
  float u = 0.0F;              ///< Barycentric weight of the triangle's second corner.
  float v = 0.0F;              ///< Barycentric weight of the third; the first has 1 − u − v.
  float t = 0.0F;              ///< The hit is at origin + t · direction.

  explicit operator bool() const { return face != kNone; }
};

/// The part of a line with tnear ≤ t ≤ tfar. The direction need not be a unit vector.
struct RaySegment {
  Vec3f origin = Vec3f::Zero();
  Vec3f direction = Vec3f::UnitZ();
  float tnear = 0.0F;
  float tfar = std::numeric_limits<float>::infinity();
};

/// Rays that are traced together, which costs less than one by one where they run alike.
using RayPacket = std::array<RaySegment, 4>;

/// How opaque a place of a surface is, in [0, 1], for a ray that is so wide there, in the mesh's
/// units; called from many threads at once.
using OpacityOfHit = std::function<double(std::uint32_t face, float u, float v, float width)>;

/// Triangles in single precision, for pictures. Rays pass no shared edge unnoticed.
class RayScene {
 public:
  /// \param mesh positions in the frame of the rays; bring them near the origin and to order 1
  ///             first (UnitFrame), because they are rounded to float.
  /// \param opacity closest hits pass through places where it is 0, count_occluded() through
  ///             those where it is below a half; empty: all is solid.
  explicit RayScene(const TriMesh& mesh, OpacityOfHit opacity = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Nearest hit with tnear ≤ t ≤ tfar. The direction need not be a unit vector.
  [[nodiscard]] RayHit closest_hit(const Vec3f& origin, const Vec3f& direction, float tnear = 0.0F,
                                   float tfar = std::numeric_limits<float>::infinity()) const;

  /// Nearest hits of the first `count` rays; the others hit nothing.
  /// \param width of the rays, for places that are partly opaque.
  [[nodiscard]] std::array<RayHit, 4> closest_hits(const RayPacket& rays, std::size_t count,
                                                   float width = 0.0F) const;

  /// How many of the first `count` rays hit something.
  [[nodiscard]] std::size_t count_occluded(const RayPacket& rays, std::size_t count,
                                           float width = 0.0F) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// Boxes of triangles, for decisions taken elsewhere in double precision: names every triangle
/// that a segment comes near, in no particular order.
class CandidateScene {
 public:
  /// \param positions in a UnitFrame. \param triangles of them.
  CandidateScene(std::span<const Vec3> positions, std::span<const Triangle> triangles);
  ~CandidateScene();
  CandidateScene(CandidateScene&&) noexcept;
  CandidateScene& operator=(CandidateScene&&) noexcept;

  /// Asks `decide(face)` about the triangles near origin + t · direction, 0 ≤ t ≤ tfar, until one
  /// answers true. No triangle that meets the segment is left out, whatever float rounding does,
  /// as long as the segment starts inside the UnitFrame's box or on it.
  /// \param direction unit vector.
  /// \return whether one answered true.
  [[nodiscard]] bool any(const Vec3& origin, const Vec3& direction, double tfar,
                         const std::function<bool(std::uint32_t face)>& decide) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace vantage
